#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "partition/metrics/volume.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/random_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// A box of quads from 0 to these sides, its faces turned outwards.
PolygonMesh box(double a, double b, double c)
{
    PolygonMesh mesh;
    mesh.vertices.resize(8, 3);
    for (Index v = 0; v < 8; ++v)
        mesh.vertices.row(v) =
            Eigen::RowVector3d((v & 1) != 0 ? a : 0.0, (v & 2) != 0 ? b : 0.0, (v & 4) != 0 ? c : 0.0);
    for (const auto& face :
         {std::array<Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        mesh.add_face(face);
    return mesh;
}

PolygonMesh with_face_turned(PolygonMesh mesh, Index f)
{
    std::reverse(mesh.face_vertices.begin() + mesh.face_offsets[f],
                 mesh.face_vertices.begin() + mesh.face_offsets[f + 1]);
    return mesh;
}

PolygonMesh without_last_face(const PolygonMesh& mesh)
{
    PolygonMesh open;
    open.vertices = mesh.vertices;
    for (Index f = 0; f + 1 < mesh.n_faces(); ++f)
        open.add_face(mesh.face(f));
    return open;
}

}  // namespace

TEST_CASE("the volume of a box, wherever it lies and whichever way its faces are turned")
{
    PolygonMesh mesh = box(2.0, 3.0, 5.0);
    CHECK(encloses_volume(mesh, run_serially));
    CHECK(volume_of_cones(mesh, mesh.vertices, mesh.vertices.row(3), run_serially) == test::relative(30.0, 1e-5));
    CHECK(volume_of_cones(mesh, mesh.vertices, Point(7.0, -3.0, 1.0), run_serially) == test::relative(30.0, 1e-5));
    mesh.vertices.rowwise() += Point(1e6, -2e6, 3e6);
    CHECK(volume_of_cones(mesh, mesh.vertices, mesh.vertices.row(0), run_serially) == test::relative(30.0, 1e-5));
    PolygonMesh turned = mesh;
    for (Index f = 0; f < turned.n_faces(); ++f)
        turned = with_face_turned(turned, f);
    CHECK(encloses_volume(turned, run_serially));
    CHECK(volume_of_cones(turned, turned.vertices, turned.vertices.row(0), run_serially) ==
          test::relative(-30.0, 1e-5));
}

TEST_CASE("a surface that is open, or whose faces are not oriented alike, has no volume")
{
    const PolygonMesh mesh = box(1.0, 1.0, 1.0);
    CHECK_FALSE(encloses_volume(PolygonMesh{}, run_serially));
    CHECK_FALSE(encloses_volume(without_last_face(mesh), run_serially));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        CHECK_FALSE(encloses_volume(with_face_turned(mesh, f), run_serially));
    CHECK_FALSE(encloses_volume(test::quad_grid(4, 3), run_serially));
}

TEST_CASE("half-edges of different edges do not cancel each other")
{
    // Every vertex has as many faces that come as faces that go.
    PolygonMesh mesh = box(1.0, 1.0, 1.0);
    PolygonMesh two_cycles;
    two_cycles.vertices = mesh.vertices;
    for (const auto& face : {std::array<Index, 4>{0, 1, 2, 3}, {0, 2, 1, 3}})
        two_cycles.add_face(face);
    CHECK_FALSE(encloses_volume(two_cycles, run_serially));
}

TEST_CASE("a surface encloses a volume as counting its half-edges one by one says, in every numbering")
{
    // The faces along each edge, in one direction less those in the other.
    const auto counted = [](const PolygonMesh& mesh) {
        std::map<std::pair<Index, Index>, int> balance;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            Index from = mesh.face(f).back();
            for (const Index to : mesh.face(f)) {
                balance[std::minmax(from, to)] += from < to ? 1 : -1;
                from = to;
            }
        }
        return mesh.n_faces() > 0 && std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
    };
    RandomNumbers random(65);
    int n_enclosing = 0;
    constexpr int n_meshes = 400;
    for (int i = 0; i < n_meshes; ++i) {
        PolygonMesh mesh = test::random_mesh(random).mesh;
        // Of closed meshes, as they are, with a face turned, and without a face.
        for (int change = 0; change < 3; ++change) {
            if (change == 1)
                mesh = with_face_turned(mesh, static_cast<Index>(random.unit() * mesh.n_faces()));
            if (change == 2)
                mesh = without_last_face(mesh);
            const bool expected = counted(mesh);
            n_enclosing += expected ? 1 : 0;
            std::vector<Index> all(usize(mesh.n_faces()));
            std::iota(all.begin(), all.end(), Index{0});
            for (std::uint32_t numbering = 0; numbering < 3; ++numbering) {
                CHECK(encloses_volume(mesh, run_serially) == expected);
                CHECK(encloses_volume(mesh, all) == expected);
                mesh = test::shuffled(mesh, numbering).mesh;
            }
        }
    }
    CHECK(n_enclosing > n_meshes / 8);
    CHECK(n_enclosing < n_meshes);
}
