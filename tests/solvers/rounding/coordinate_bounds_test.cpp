#include <cmath>
#include <functional>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "tests/support/digitised.h"

using namespace seamflow;
using test::ball;

namespace {

using Kind = CoordinateBounds::Kind;

CoordinateBounds found_for(const Points& points, double length = 1.0)
{
    // Each vertex beside the next one.
    IndexLists neighbours;
    const auto n = static_cast<Index>(points.rows());
    for (Index v = 0; v < n; ++v) {
        neighbours.values.push_back((v + 1) % n);
        neighbours.values.push_back((v + n - 1) % n);
        neighbours.close();
    }
    return bounds_of(
        points, neighbours, {}, [length](const std::function<bool(Index)>&) { return SurfaceSize{.edge = length}; },
        run_in_parallel);
}

double slope(double x, double y)
{
    return 6.0 * std::sin(x / 7.0) * std::cos(y / 9.0) + 0.1 * x;
}

double gentle_slope(double x, double y)
{
    return 0.02 * slope(x, y);
}

}  // namespace

TEST_CASE("each coordinate of voxels lies within half a step")
{
    const CoordinateBounds bounds = found_for(test::voxel_faces(ball(7.3), 20).vertices);
    CHECK(bounds.kind == Kind::Any);
    CHECK((bounds.steps - Point::Ones()).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((bounds.half_widths.array() - 0.5).abs().maxCoeff() < 1e-9);
}

TEST_CASE("vertices of marching cubes stay near the edge of the lattice on which they are")
{
    for (const Point& spacing : {Point(1.0, 1.0, 1.0), Point(0.5, 0.5, 2.5)}) {
        CAPTURE(spacing);
        const PolygonMesh mesh = test::crossed_edges(ball(6.3), 17, spacing);
        const CoordinateBounds bounds = found_for(mesh.vertices, 0.8);
        CHECK(bounds.kind == Kind::MarchingCubes);
        CHECK((bounds.steps - spacing).cwiseAbs().maxCoeff() < 1e-9);
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            int along = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double planes = mesh.vertices(v, axis) / spacing[axis];
                const bool is_between = std::abs(planes - std::round(planes)) > 0.25;
                const double width = bounds.half_widths(v, axis);
                along += is_between ? 1 : 0;
                if (is_between)
                    CHECK(std::abs(width - 0.5 * spacing[axis]) < 1e-9);
                else
                    CHECK(width < 0.4 * spacing.minCoeff());
            }
            REQUIRE(along == 1);
        }
    }
}

TEST_CASE("heights move, and their places do not: on a grid, at any places, and on walls of other axes")
{
    const PolygonMesh grid = test::rounded(test::height_grid(30, slope), Point(0.0, 0.0, 0.5));
    Points scattered = grid.vertices;
    for (Index v = 0; v < scattered.rows(); ++v)
        scattered.row(v).head<2>() += Eigen::RowVector2d(0.3 * std::sin(1.7 * v), 0.3 * std::cos(2.3 * v));
    for (const Points& points : {grid.vertices, scattered})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(axis);
            Points turned(points.rows(), 3);
            for (int k = 0; k < 3; ++k)
                turned.col((axis + 1 + k) % 3) = points.col(k);
            const CoordinateBounds bounds = found_for(turned);
            CHECK(bounds.kind == Kind::Heights);
            for (int k = 0; k < 3; ++k)
                CHECK((bounds.half_widths.col(k).array() - (k == axis ? 0.25 : 0.0)).abs().maxCoeff() < 1e-9);
        }
}

TEST_CASE("exact heights on a grid are not rounded, though the grid is")
{
    CHECK(found_for(test::height_grid(30, slope).vertices).kind == Kind::None);
}

TEST_CASE("steps that nobody sees do not count")
{
    const PolygonMesh voxels = test::voxel_faces(ball(7.3), 20);
    CHECK(found_for(voxels.vertices, 9.0).kind == Kind::Any);
    CHECK(found_for(voxels.vertices, 11.0).kind == Kind::None);
    const PolygonMesh heights = test::rounded(test::height_grid(60, gentle_slope), Point(0.0, 0.0, 0.02));
    CHECK(found_for(heights.vertices).kind == Kind::Heights);
    const PolygonMesh fine = test::rounded(test::height_grid(60, gentle_slope), Point(0.0, 0.0, 0.009));
    CHECK(found_for(fine.vertices).kind == Kind::None);
}
