#include <algorithm>
#include <array>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/flipped_faces.h"
#include "samples/meshes/meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Turned around the x axis.
Points turned(const Points& positions, double degrees)
{
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitX());
    return positions * turn.toRotationMatrix().transpose();
}

}  // namespace

TEST_CASE("faces are flipped that turn by more than a right angle")
{
    const PolygonMesh mesh = quad_grid(4, 3);
    for (const double degrees : {0.0, 45.0, 89.0, -89.0, 271.0})
        CHECK(flipped_faces(mesh, mesh.vertices, turned(mesh.vertices, degrees)).empty());
    for (const double degrees : {91.0, 180.0, -91.0})
        CHECK(flipped_faces(mesh, mesh.vertices, turned(mesh.vertices, degrees)).size() == 12);
}

TEST_CASE("one face is flipped where one corner goes across it, at any size")
{
    const PolygonMesh mesh = triangle_grid(4, 4);
    for (const double scale : {1e-150, 1e-100, 1.0, 1e100}) {
        Points after = mesh.vertices;
        // The corner of the grid that is in one triangle alone goes beyond the opposite edge.
        constexpr std::array<Index, 4> corners{0, 4, 20, 24};
        const Index v = *std::ranges::find_if(
            corners, [&](Index corner) { return std::ranges::count(mesh.face_vertices, corner) == 1; });
        after.row(v) = Point(2, 2, 0);
        const auto flipped = flipped_faces(mesh, scale * mesh.vertices, scale * after);
        REQUIRE(flipped.size() == 1);
        CHECK(std::ranges::count(mesh.face(flipped[0]), v) == 1);
    }
}

TEST_CASE("faces without area are not counted, and threads do not matter")
{
    const PolygonMesh mesh = make_noisy_sphere(9000, {.noise = 0.9});
    const PolygonMesh smooth = make_noisy_sphere(9000, {.noise = 0.0});
    const auto flipped = flipped_faces(mesh, mesh.vertices, smooth.vertices);
    CHECK_FALSE(flipped.empty());
    CHECK(std::ranges::is_sorted(flipped));
    CHECK(flipped_faces(mesh, mesh.vertices, smooth.vertices, run_in_parallel) == flipped);
    CHECK(flipped_faces(mesh, smooth.vertices, mesh.vertices) == flipped);
    CHECK(flipped_faces(mesh, mesh.vertices, Points::Zero(mesh.n_vertices(), 3)).empty());
    CHECK(flipped_faces(mesh, Points::Zero(mesh.n_vertices(), 3), mesh.vertices).empty());
}
