#include <cmath>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("a mesh has no distance from itself")
{
    for (const NamedMesh& m : assorted_meshes()) {
        const VertexDistance distance = vertex_distance(m.mesh, m.mesh.vertices, m.mesh.vertices);
        CHECK(distance.mean == 0.0);
        CHECK(distance.rms == 0.0);
        CHECK(distance.max == 0.0);
        CHECK(distance.mean_edge == mean_edge_length(m.mesh));
    }
}

TEST_CASE("a mesh moved as a whole has the same distance everywhere")
{
    const PolygonMesh mesh = quad_torus(8, 6);
    const Points moved = mesh.vertices.rowwise() + Eigen::RowVector3d(2, -3, 6);
    const VertexDistance distance = vertex_distance(mesh, mesh.vertices, moved);
    CHECK(distance.mean == relative(7.0, 1e-5));
    CHECK(distance.rms == relative(7.0, 1e-5));
    CHECK(distance.max == relative(7.0, 1e-5));
}

TEST_CASE("mean, root mean square and largest distance are over all vertices")
{
    const PolygonMesh mesh = quad_grid(1, 1);
    Points moved = mesh.vertices;
    moved.row(1) += Eigen::RowVector3d(3, 0, 4);
    moved.row(3) += Eigen::RowVector3d(0, 0, -1);
    const VertexDistance distance = vertex_distance(mesh, mesh.vertices, moved);
    CHECK(distance.mean == relative(6.0 / 4.0, 1e-5));
    CHECK(distance.rms == relative(std::sqrt(26.0 / 4.0), 1e-5));
    CHECK(distance.max == relative(5.0, 1e-5));
}

TEST_CASE("the mean edge length counts an interior edge twice and is that of the reference")
{
    PolygonMesh mesh = quad_grid(2, 1);
    CHECK(mean_edge_length(mesh) == relative(1.0, 1e-5));
    mesh.vertices.col(0) *= 3.0;
    // Four half-edges of length 1, the two in the middle among them, and four of length 3.
    CHECK(mean_edge_length(mesh) == relative(2.0, 1e-5));
    const Points larger = 2.0 * mesh.vertices;
    CHECK(mean_edge_length(mesh, larger) == relative(4.0, 1e-5));
    CHECK(vertex_distance(mesh, larger, mesh.vertices).mean_edge == relative(4.0, 1e-5));
    CHECK(mean_edge_length(PolygonMesh{}) == 0.0);
}

TEST_CASE("meshes of different numbers of vertices cannot be compared")
{
    const PolygonMesh mesh = quad_grid(1, 1);
    CHECK_THROWS_WITH_AS(vertex_distance(mesh, mesh.vertices, Points(mesh.vertices.topRows(3))),
                         "the reference has 4 vertices, the candidate 3: only meshes with corresponding vertices can "
                         "be compared",
                         InputError);
}

TEST_CASE("positions that are not the mesh's in number are refused")
{
    const PolygonMesh mesh = quad_grid(2, 2);
    const Points fewer = mesh.vertices.topRows(4);
    CHECK_THROWS_WITH_AS(vertex_distance(mesh, fewer, fewer), doctest::Contains("the mesh has 9 vertices"), InputError);
}
