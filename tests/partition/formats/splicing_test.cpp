#include <doctest/doctest.h>

#include "partition/formats/splicing.h"
#include "tests/support/mesh_files.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

TEST_CASE("normals of faces that have not moved stay, those of others turn with them")
{
    PolygonMesh mesh = test::quad_grid(6, 6);
    const Points before = mesh.vertices;
    const Index corner = 0;
    mesh.vertices.row(mesh.face(0)[0]) += Point(0, 0, 1);
    const MovedNormals normals(mesh, before);
    CHECK(normals.moved());
    CHECK_FALSE(MovedNormals(mesh, mesh.vertices).moved());
    const Point up(0, 0, 1);
    CHECK_FALSE(normals.around_vertex(mesh.face(mesh.n_faces() - 1)[2], up).has_value());
    CHECK_FALSE(normals.of_face(mesh.n_faces() - 1, up).has_value());
    const auto tilted = normals.of_face(normals.face_of(corner), up);
    REQUIRE(tilted.has_value());
    CHECK(std::abs(tilted->norm() - 1.0) < 1e-15);
    CHECK(tilted->dot(up) > 0.5);
    CHECK(normals.of_face(0, -up) == std::optional<Point>(-*tilted));
    CHECK(normals.around_vertex(mesh.face(0)[0], -up)->dot(up) < -0.5);
}

TEST_CASE("the normal of some corners is that of their faces alone")
{
    PolygonMesh mesh = test::quad_grid(2, 2);
    const Points before = mesh.vertices;
    mesh.vertices.col(2) = mesh.vertices.col(0);
    const MovedNormals normals(mesh, before);
    for (Index corner = 0; corner < mesh.n_corners(); ++corner) {
        const std::vector<Index> one = {corner};
        const auto normal = normals.around_vertex(one, Point(0, 0, 1));
        REQUIRE(normal.has_value());
        CHECK((*normal - Point(-1, 0, 1).normalized()).norm() < 1e-15);
    }
}
