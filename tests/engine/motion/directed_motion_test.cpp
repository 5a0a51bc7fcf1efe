#include <doctest/doctest.h>

#include "engine/motion/directed_motion.h"
#include "partition/topology.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

TEST_CASE("a vertex of the boundary whose line misses the moved surface stays")
{
    const PolygonMesh grid = test::triangle_grid(10, 10);
    Topology topology = make_topology(grid);
    free_boundary(topology);
    const DirectedMotion motion(grid, topology, {MotionDirection::Kind::Vector, Point(0.0, 0.0, 1.0)});
    // The corner at the origin is pulled in over other faces, where the surface rises steeply.
    Points after = grid.vertices;
    after.col(2).array() += 0.25;
    after.row(0) = Point(2.5, 2.5, 40.0);
    motion.project(grid.vertices, after, run_serially);
    CHECK(after.row(0).cwiseEqual(grid.vertices.row(0)).all());
    CHECK((after.col(2).array() - 0.25).abs().maxCoeff() < 1.5);
}
