#include <cmath>

#include <doctest/doctest.h>

#include "samples/meshes/meshes.h"
#include "solvers/laplacian/mean_curvature.h"
#include "tests/support/flows.h"
#include "tests/support/matrices.h"
#include "tests/support/reference_data.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

void check_is_laplacian_of_positions(const PolygonMesh& mesh, const Topology& topology)
{
    for (const Laplacian laplacian : all_laplacians) {
        CAPTURE(name_of(laplacian));
        const Points expected = dense_laplacian(laplacian, mesh, topology) * mesh.vertices;
        const double scale = expected.rowwise().norm().maxCoeff() + 1.0 / mesh.vertices.cwiseAbs().maxCoeff();
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (topology.kind[v] == VertexKind::Interior) {
                const Point found = mean_curvature_vector(mesh, topology, mesh.vertices, laplacian, v);
                CHECK((found - expected.row(v)).norm() <= 1e-10 * scale);
            }
    }
}

}  // namespace

TEST_CASE("the mean curvature vector is the Laplacian's row applied to the positions")
{
    for (const auto& file : reference_files("operators")) {
        CAPTURE(file.filename().string());
        const PolygonMesh mesh = read_operators(file).mesh;
        check_is_laplacian_of_positions(mesh, make_topology(mesh));
    }
    for (const NamedMesh& m : sound_meshes()) {
        CAPTURE(m.name);
        check_is_laplacian_of_positions(m.mesh, m.topology);
    }
}

TEST_CASE("positions other than the mesh's own count, and orientation does not")
{
    const PolygonMesh mesh = quad_torus(14, 9);
    const PolygonMesh flipped = with_faces_flipped(mesh, 1);
    const Topology topology = make_topology(mesh);
    const Topology flipped_topology = make_topology(flipped);
    const Points doubled = 2.0 * mesh.vertices;
    for (const Laplacian laplacian : geometric_laplacians)
        for (Index v = 0; v < mesh.n_vertices(); ++v) {
            const Point once = mean_curvature_vector(mesh, topology, mesh.vertices, laplacian, v);
            const Point twice = mean_curvature_vector(mesh, topology, doubled, laplacian, v);
            const Point turned = mean_curvature_vector(flipped, flipped_topology, mesh.vertices, laplacian, v);
            CHECK((2.0 * twice - once).norm() < 1e-12 * once.norm());
            CHECK((turned - once).norm() < 1e-12 * once.norm());
        }
}

TEST_CASE("the mean curvature of a round tube is one over its radius, outward")
{
    CylinderShape shape;
    shape.radius = 0.5;
    shape.amplitude = 0.0;
    const PolygonMesh mesh = make_cylinder(4000, shape);
    const Topology topology = make_topology(mesh);
    for (const Laplacian laplacian : geometric_laplacians)
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            if (topology.kind[v] == VertexKind::Interior) {
                const Point outward = mesh.vertices.row(v).cwiseProduct(Point(1, 1, 0)).normalized();
                const Point found = mean_curvature_vector(mesh, topology, mesh.vertices, laplacian, v);
                CHECK((found - 2.0 * outward).norm() < 0.05);
            }
}
