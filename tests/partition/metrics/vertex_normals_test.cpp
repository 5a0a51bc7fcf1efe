#include <algorithm>

#include <doctest/doctest.h>

#include "partition/metrics/vertex_normals.h"
#include "samples/meshes/meshes.h"
#include "tests/support/mesh_files.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

Points normals_of(const PolygonMesh& mesh)
{
    const Topology topology = make_topology(mesh);
    const VertexNormals normals(mesh, topology);
    Points all(mesh.n_vertices(), 3);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        all.row(v) = normals(v, mesh.vertices);
    return all;
}

/// Every third face the other way round.
PolygonMesh with_turned_faces(const PolygonMesh& mesh)
{
    PolygonMesh turned = mesh;
    for (Index f = 0; f < mesh.n_faces(); f += 3)
        std::reverse(turned.face_vertices.begin() + mesh.face_offsets[f],
                     turned.face_vertices.begin() + mesh.face_offsets[f + 1]);
    return turned;
}

}  // namespace

TEST_CASE("normals of a plane are those of the plane, at its rim, too")
{
    for (const PolygonMesh& mesh : {test::quad_grid(4, 3), test::triangle_grid(4, 3)}) {
        const Points normals = normals_of(mesh);
        CHECK((normals.col(2).array().abs() - 1.0).abs().maxCoeff() == 0.0);
        CHECK(normals.leftCols(2).cwiseAbs().maxCoeff() == 0.0);
    }
}

TEST_CASE("large faces count for more")
{
    const PolygonMesh roof = test::make_mesh(Points{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}},
                                             {{0, 1, 2}, {0, 3, 1}});
    CHECK((normals_of(roof).row(0) - Point(0.0, 1.0, 3.0).normalized()).norm() < 1e-15);
}

TEST_CASE("faces need not be oriented alike")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(400), make_noisy_sphere(400), test::cylinder(7, 5)}) {
        const Points expected = normals_of(mesh);
        const Points normals = normals_of(with_turned_faces(mesh));
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            CHECK(std::min((normals.row(v) - expected.row(v)).norm(), (normals.row(v) + expected.row(v)).norm()) <
                  1e-14);
    }
}

TEST_CASE("there is no normal where nothing decides about it")
{
    PolygonMesh mesh = test::quad_grid(1, 1);
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.bottomRows(1).setZero();
    CHECK(normals_of(mesh).row(4).norm() == 0.0);
    CHECK(normals_of(mesh).row(0).norm() == 1.0);
    mesh.vertices.col(1).setZero();
    CHECK(normals_of(mesh).norm() == 0.0);
}
