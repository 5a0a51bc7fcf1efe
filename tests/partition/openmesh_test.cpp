#include <algorithm>
#include <numeric>

#include <doctest/doctest.h>

#include "partition/openmesh.h"
#include "samples/meshes/meshes.h"
#include "tests/support/openmesh.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

static_assert(OpenMeshMesh<FloatPolyMesh>);
static_assert(OpenMeshMesh<DoublePolyMesh>);
static_assert(OpenMeshMesh<FloatTriMesh>);
static_assert(OpenMeshMesh<DoubleTriMesh>);
static_assert(!OpenMeshMesh<PolygonMesh>);

namespace {

/// The corners of a face, beginning with the lowest: OpenMesh may begin elsewhere.
std::vector<Index> from_lowest(std::span<const Index> face)
{
    std::vector<Index> corners(face.begin(), face.end());
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

void check_same_faces(const PolygonMesh& found, const PolygonMesh& expected)
{
    REQUIRE(found.n_faces() == expected.n_faces());
    for (Index f = 0; f < expected.n_faces(); ++f)
        CHECK(from_lowest(found.face(f)) == from_lowest(expected.face(f)));
}

/// Positions as they are in a mesh of this kind.
template <class Mesh>
Points in_precision_of(const Points& positions)
{
    return positions.cast<typename Mesh::Scalar>().template cast<double>();
}

/// Rows 1, 3, 4 … without those listed.
Points without_rows(const Points& positions, const std::vector<Index>& rows)
{
    std::vector<Index> kept;
    for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v)
        if (std::find(rows.begin(), rows.end(), v) == rows.end())
            kept.push_back(v);
    return positions(kept, Eigen::all);
}

}  // namespace

TEST_CASE_TEMPLATE("faces come over with their order, in single and in double precision", Mesh, FloatPolyMesh,
                   DoublePolyMesh, FloatTriMesh, DoubleTriMesh)
{
    const bool has_triangles = std::is_same_v<Mesh, FloatTriMesh> || std::is_same_v<Mesh, DoubleTriMesh>;
    const PolygonMesh mesh = has_triangles ? make_noisy_sphere(150) : make_mixed_polygons(200);
    const PolygonMesh found = to_polygon_mesh(openmesh_of<Mesh>(mesh));
    check_same_faces(found, mesh);
    CHECK(found.vertices == in_precision_of<Mesh>(mesh.vertices));
}

TEST_CASE("an empty mesh and vertices without faces come over")
{
    CHECK(to_polygon_mesh(FloatPolyMesh()).n_vertices() == 0);
    CHECK(to_polygon_mesh(FloatPolyMesh()).n_faces() == 0);
    PolygonMesh mesh = quad_grid(1, 1);
    mesh.vertices.conservativeResize(5, 3);
    mesh.vertices.row(4) << 7, 8, 9;
    CHECK(to_polygon_mesh(openmesh_of<DoublePolyMesh>(mesh)).vertices == mesh.vertices);
}

TEST_CASE_TEMPLATE("deleted elements are left out and the others keep their order", Mesh, FloatPolyMesh, DoublePolyMesh)
{
    const PolygonMesh grid = quad_grid(4, 3);
    Mesh mesh = openmesh_of<Mesh>(grid);
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    // A corner vertex takes its face with it; a face alone leaves its vertices.
    mesh.delete_vertex(mesh.vertex_handle(0), false);
    mesh.delete_face(mesh.face_handle(6), false);
    const PolygonMesh found = to_polygon_mesh(mesh);
    CHECK(found.vertices == without_rows(grid.vertices, {0}));
    REQUIRE(found.n_faces() == 10);
    std::vector<Index> kept(12);
    std::iota(kept.begin(), kept.end(), 0);
    std::erase_if(kept, [](Index f) { return f == 0 || f == 6; });
    for (Index f = 0; f < 10; ++f) {
        std::vector<Index> expected = from_lowest(grid.face(kept[f]));
        std::for_each(expected.begin(), expected.end(), [](Index& v) { --v; });
        CHECK(from_lowest(found.face(f)) == expected);
    }
}

TEST_CASE_TEMPLATE("positions go back in the same order, past deleted vertices", Mesh, FloatPolyMesh, DoublePolyMesh,
                   FloatTriMesh, DoubleTriMesh)
{
    Mesh mesh = openmesh_of<Mesh>(triangle_grid(4, 3));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    mesh.delete_vertex(mesh.vertex_handle(4), false);
    mesh.delete_vertex(mesh.vertex_handle(7), false);
    const Points before = to_polygon_mesh(mesh).vertices;
    const typename Mesh::Point untouched = mesh.point(mesh.vertex_handle(7));
    Points moved = before;
    moved.col(2).setLinSpaced(0.1, 0.7);
    set_positions(mesh, moved);
    CHECK(to_polygon_mesh(mesh).vertices == in_precision_of<Mesh>(moved));
    CHECK(mesh.point(mesh.vertex_handle(7)) == untouched);
}
