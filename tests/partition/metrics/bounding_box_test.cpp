#include <limits>

#include <doctest/doctest.h>

#include "partition/metrics/bounding_box.h"
#include "samples/meshes/meshes.h"

using namespace seamflow;

TEST_CASE("the box around a surface is that of the vertices that have faces")
{
    PolygonMesh mesh = make_quads(100);
    const Points before = mesh.vertices;
    const BoundingBox alone = box_of_faces(mesh);
    CHECK(alone.low == Eigen::RowVector3d(before.colwise().minCoeff()));
    CHECK(alone.high == Eigen::RowVector3d(before.colwise().maxCoeff()));
    CHECK(alone.diagonal() == (alone.high - alone.low).norm());
    mesh.vertices.conservativeResize(before.rows() + 2, 3);
    mesh.vertices.bottomRows(2) << 1e9, -1e9, 0.0, 1.0, 2.0, 1e9;
    const BoundingBox box = box_of_faces(mesh);
    CHECK(box.low == alone.low);
    CHECK(box.high == alone.high);
    CHECK(box_of_faces(PolygonMesh{}).diagonal() == 0.0);
}

TEST_CASE("positions that are not finite are not in the box")
{
    PolygonMesh mesh = make_quads(100);
    const BoundingBox before = box_of_faces(mesh);
    // A vertex inside.
    mesh.vertices(55, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK(box_of_faces(mesh).diagonal() == before.diagonal());
}

TEST_CASE("vertices are far from the faces where they lie outside by more than the diagonal of the box")
{
    PolygonMesh mesh = make_quads(100);
    const BoundingBox box = box_of_faces(mesh);
    const Index n = mesh.n_vertices();
    mesh.vertices.conservativeResize(n + 3, 3);
    mesh.vertices.row(n) = box.low;
    mesh.vertices.row(n + 1) = box.high + Point(0.9 * box.diagonal(), 0.0, 0.0);
    mesh.vertices.row(n + 2) = box.high + Point(1.1 * box.diagonal(), 0.0, 0.0);
    const std::vector<Index> unused{n, n + 1, n + 2};
    CHECK(far_from_faces(box, mesh.vertices, unused) == std::vector<Index>{n + 2});
    CHECK(far_from_faces(box, mesh.vertices, {}).empty());
}
