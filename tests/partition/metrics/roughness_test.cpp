#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "partition/metrics/roughness.h"
#include "partition/metrics/triangulation.h"
#include "partition/topology.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// The positions with every other vertex lifted, so that neighbours differ by this height.
Points lifted(const PolygonMesh& mesh, double height)
{
    std::vector<int> sides(mesh.n_vertices(), -1);
    sides[0] = 0;
    for (bool found = true; found;) {
        found = false;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            const auto face = mesh.face(f);
            for (std::size_t k = 0; k < 2 * face.size(); ++k) {
                int& next = sides[face[(k + 1) % face.size()]];
                const int here = sides[face[k % face.size()]];
                if (here >= 0 && next < 0) {
                    next = 1 - here;
                    found = true;
                }
            }
        }
    }
    Points positions = mesh.vertices;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        positions(v, 2) += height * sides[v];
    return positions;
}

/// One polygon.
PolygonMesh polygon(const std::vector<std::array<double, 3>>& corners)
{
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
    std::vector<Index> face;
    for (const auto& corner : corners) {
        mesh.vertices.row(static_cast<Eigen::Index>(face.size())) = Eigen::RowVector3d(corner[0], corner[1], corner[2]);
        face.push_back(static_cast<Index>(face.size()));
    }
    mesh.add_face(face);
    return mesh;
}

}  // namespace

TEST_CASE("flat meshes are not rough")
{
    for (const PolygonMesh& mesh : {test::quad_grid(5, 4), test::triangle_grid(5, 4), test::hexagon_sheet(5, 4)}) {
        CHECK(roughness(mesh, mesh.vertices).rms < 1e-6);
        CHECK(roughness(mesh, mesh.vertices).percentile_95 < 1e-6);
    }
}

TEST_CASE("a flat patch with every other vertex lifted is rough in proportion")
{
    for (const PolygonMesh& mesh : {test::quad_grid(8, 8), test::hexagon_sheet(8, 8)}) {
        CAPTURE(mesh.face(20).size());
        const Roughness tenth = roughness(mesh, lifted(mesh, 0.1));
        CHECK(tenth.rms > 5.0);
        CHECK(tenth.percentile_95 >= tenth.rms);
        for (const double times : {0.25, 0.5, 2.0}) {
            const Roughness other = roughness(mesh, lifted(mesh, 0.1 * times));
            CHECK(other.rms == test::relative(times * tenth.rms, 0.05));
            CHECK(other.percentile_95 == test::relative(times * tenth.percentile_95, 0.05));
        }
    }
}

TEST_CASE("a smooth cylinder bends by what its columns turn, and by no more")
{
    const PolygonMesh mesh = test::cylinder(60, 20);
    const Roughness smooth = roughness(mesh, mesh.vertices);
    CHECK(smooth.percentile_95 == test::relative(6.0, 1e-5));
    CHECK(smooth.rms < 6.0);
    const PolygonMesh finer = test::cylinder(120, 20);
    CHECK(roughness(finer, finer.vertices).rms == test::relative(smooth.rms / 2.0, 0.01));
}

TEST_CASE("two triangles have the angle between them, however they are oriented")
{
    PolygonMesh mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -std::cos(0.3), std::sin(0.3);
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    const double degrees = 0.3 * 180.0 / std::numbers::pi;
    for (const auto& second : {std::array<Index, 3>{1, 0, 3}, std::array<Index, 3>{0, 1, 3}}) {
        PolygonMesh both = mesh;
        both.add_face(second);
        CHECK(roughness(both, both.vertices).rms == test::relative(degrees, 1e-5));
        CHECK(roughness(both, both.vertices).percentile_95 == test::relative(degrees, 1e-5));
    }
}

TEST_CASE("a few spikes are seen in the root mean square, many in the percentile")
{
    const PolygonMesh mesh = test::quad_grid(20, 20);
    Points positions = mesh.vertices;
    positions(220, 2) = 5.0;
    const Roughness spike = roughness(mesh, positions);
    CHECK(spike.rms > 5.0);
    CHECK(spike.percentile_95 < 1e-6);
}

TEST_CASE("flat polygons are flat, convex or not, with corners in line or without area")
{
    // A bracket, whose centre lies outside.
    const PolygonMesh bracket = polygon({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {0, 1, 0}});
    CHECK(fans_around_centres(bracket, bracket.vertices).triangles.n_faces() == 4);
    CHECK(roughness(bracket, bracket.vertices).rms < 1e-6);
    const PolygonMesh in_line = polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    CHECK(fans_around_centres(in_line, in_line.vertices).triangles.n_faces() == 5);
    CHECK(roughness(in_line, in_line.vertices).rms < 1e-6);
    const PolygonMesh nothing = polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}});
    CHECK(roughness(nothing, nothing.vertices).rms == 0.0);
}

TEST_CASE("what is not finite is left out")
{
    const PolygonMesh mesh = test::hexagon_sheet(6, 6);
    Points positions = lifted(mesh, 0.1);
    positions(0, 0) = std::nan("");
    CHECK(roughness(mesh, positions).rms > 5.0);
    CHECK(roughness(PolygonMesh{}, Points(0, 3)).rms == 0.0);
}

TEST_CASE("fans have their centres after the vertices, and cover each face once")
{
    const PolygonMesh mesh = test::hexagon_sheet(3, 3);
    const CentreFans fans = fans_around_centres(mesh, mesh.vertices);
    REQUIRE(fans.triangles.n_vertices() == mesh.n_vertices() + mesh.n_faces());
    REQUIRE(fans.triangles.n_faces() == mesh.n_corners());
    REQUIRE(fans.faces.size() == usize(mesh.n_corners()));
    CHECK(fans.faces.front() == 0);
    CHECK(fans.faces.back() == mesh.n_faces() - 1);
    CHECK(fans.triangles.vertices.topRows(mesh.n_vertices()) == mesh.vertices);
    const auto first = mesh.face(0);
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (const Index v : first)
        mean += mesh.vertices.row(v) / static_cast<double>(first.size());
    CHECK((fans.triangles.vertices.row(mesh.n_vertices()) - mean).norm() < 1e-12);
    const PolygonMesh triangles = test::triangle_grid(3, 3);
    CHECK(fans_around_centres(triangles, triangles.vertices).triangles.face_vertices == triangles.face_vertices);
}
