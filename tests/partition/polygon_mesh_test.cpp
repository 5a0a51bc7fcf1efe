#include <array>
#include <functional>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/polygon_mesh.h"
#include "tests/support/messages.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// What require_valid says of a grid of 4 quads and 9 vertices that has been spoilt.
std::string complaint(const std::function<void(PolygonMesh&)>& spoil)
{
    PolygonMesh mesh = quad_grid(2, 2);
    spoil(mesh);
    return message_of<InputError>([&] { require_valid(mesh); });
}

}  // namespace

TEST_CASE("faces are appended and read back")
{
    PolygonMesh mesh;
    CHECK(mesh.n_vertices() == 0);
    CHECK(mesh.n_faces() == 0);
    mesh.add_face(std::array{0, 1, 2});
    mesh.add_face(std::array{3, 2, 1, 0, 4});
    CHECK(mesh.n_faces() == 2);
    CHECK(mesh.n_corners() == 8);
    CHECK(std::vector<Index>(mesh.face(0).begin(), mesh.face(0).end()) == std::vector<Index>{0, 1, 2});
    CHECK(std::vector<Index>(mesh.face(1).begin(), mesh.face(1).end()) == std::vector<Index>{3, 2, 1, 0, 4});
}

TEST_CASE("meshes of every sort are valid, manifold or not")
{
    for (const NamedMesh& m : assorted_meshes()) {
        CAPTURE(m.name);
        CHECK_NOTHROW(require_valid(m.mesh));
    }
    CHECK_NOTHROW(require_valid(moebius_band(8, 3)));
}

TEST_CASE("arrays that do not fit together are refused")
{
    const std::string expected = "face_offsets must begin with 0, not decrease, and end with the number of "
                                 "face_vertices (16)";
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets.clear(); }) == expected);
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets.front() = 1; }) == expected);
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets.back() = 15; }) == expected);
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets.back() = 17; }) == expected);
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets[1] = 9; }) == expected);
    CHECK(complaint([](PolygonMesh& m) { m.face_offsets[1] = -4; }) == expected);
}

TEST_CASE("the first bad face is named")
{
    const std::string few = complaint([](PolygonMesh& m) { m.add_face(std::array{0, 1}); });
    CHECK(contains(few, "face 4 (numbered from 0) has 2 corners"));
    const std::string none = complaint([](PolygonMesh& m) { m.add_face({}); });
    CHECK(contains(none, "face 4 (numbered from 0) has 0 corners"));
    const std::string high = complaint([](PolygonMesh& m) { m.face_vertices[9] = 9; });
    CHECK(contains(high, "face 2 (numbered from 0) names vertex 9, but the mesh has 9 vertices"));
    const std::string negative = complaint([](PolygonMesh& m) { m.face_vertices[4] = -1; });
    CHECK(contains(negative, "face 1 (numbered from 0) names vertex -1"));
    const std::string twice = complaint([](PolygonMesh& m) { m.face_vertices[14] = m.face_vertices[12]; });
    CHECK(contains(twice, "face 3 (numbered from 0) names vertex 4 twice"));
    const std::string first = complaint([](PolygonMesh& m) { m.face_vertices[5] = m.face_vertices[9] = 100; });
    CHECK(contains(first, "face 1 (numbered from 0)"));
}

TEST_CASE("the first vertex that lies nowhere is named")
{
    for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()})
        for (Index c = 0; c < 3; ++c) {
            const std::string message = complaint([&](PolygonMesh& m) {
                m.vertices(7, 0) = bad;
                m.vertices(5, c) = bad;
            });
            CHECK(contains(message, "vertex 5 (numbered from 0)"));
        }
}
