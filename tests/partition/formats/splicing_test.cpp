#include <vector>

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

TEST_CASE("normals stay continuous across a seam as wide as is said")
{
    const PolygonMesh whole = test::quad_grid(6, 6);
    const double middle = 0.5 * (whole.vertices.col(0).minCoeff() + whole.vertices.col(0).maxCoeff());
    PolygonMesh mesh = test::split(whole, test::halves(whole, middle));
    constexpr double gap = 1e-3;
    const auto bend = [&](double left, double right) {
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const double x = mesh.vertices(v, 0) - middle;
            mesh.vertices(v, 2) = (x < 0.0 ? left : right) * x;
        }
    };
    // Copies are the last.
    mesh.vertices.bottomRows(mesh.n_vertices() - whole.n_vertices()).col(1).array() += gap;
    bend(0.5, -0.5);
    const Points before = mesh.vertices;
    bend(0.2, -0.9);
    const Index copy = mesh.n_vertices() - 3;
    const Index of_copy = test::originals(mesh, whole)[copy];
    const Point ridge(0, 0, 1);
    for (const double distance : {0.0, 2.0 * gap}) {
        const MovedNormals normals(mesh, before, run_serially, distance);
        const Point here = *normals.around_vertex(of_copy, ridge);
        const Point there = *normals.around_vertex(copy, ridge);
        CHECK(((here - there).norm() < 1e-2) == (distance > 0.0));
    }
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
