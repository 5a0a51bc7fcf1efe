#include <cmath>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::all_laplacians;
using test::flowed;
using test::height_fields;
using test::largest_difference;

namespace {

PolygonMesh flat(PolygonMesh mesh)
{
    mesh.vertices.col(2).setZero();
    return mesh;
}

FlowOptions sweep_options(Laplacian laplacian, Index subdomains)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.laplacian = laplacian;
    options.time_step = 0.002;
    options.steps = 3;
    options.cut.subdomains = subdomains;
    return options;
}

}  // namespace

TEST_CASE("a flat mesh stays flat whatever the cut")
{
    for (const PolygonMesh& mesh : height_fields())
        for (const Laplacian laplacian : all_laplacians)
            for (const Index subdomains : {1, 2, 5, 16}) {
                CAPTURE(name_of(laplacian));
                CAPTURE(subdomains);
                const Points result = flowed(flat(mesh), sweep_options(laplacian, subdomains));
                CHECK(result.allFinite());
                CHECK(result.col(2).cwiseAbs().maxCoeff() == 0.0);
            }
}

TEST_CASE("with Alexa-Wardetzky a flat mesh of triangles does not move at all without the correction")
{
    const PolygonMesh mesh = flat(make_triangles(900));
    for (const Index subdomains : {1, 2, 5, 16}) {
        FlowOptions options = sweep_options(Laplacian::AlexaWardetzky, subdomains);
        options.interface.correction = Correction::None;
        CHECK(largest_difference(flowed(mesh, options), mesh.vertices) <= 1e-12);
    }
}

TEST_CASE("boundary vertices and vertices without faces stay to the bit")
{
    for (PolygonMesh mesh : height_fields()) {
        mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
        mesh.vertices.row(mesh.n_vertices() - 1) << 0.1, 0.2, 0.3;
        const Topology topology = make_topology(mesh);
        for (const Laplacian laplacian : all_laplacians) {
            const Points result = flowed(mesh, sweep_options(laplacian, 6));
            int moved = 0;
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (topology.kind[v] == VertexKind::Interior)
                    moved += (result.row(v) - mesh.vertices.row(v)).norm() > 0.0 ? 1 : 0;
                else
                    CHECK(result.row(v) == mesh.vertices.row(v));
            CHECK(moved > 700);
        }
    }
}

TEST_CASE("components that nothing joins flow as they do alone")
{
    const PolygonMesh first = make_triangles(400);
    const PolygonMesh second = make_hexagons(400);
    const PolygonMesh both = test::side_by_side({first, second});
    for (const Laplacian laplacian : all_laplacians) {
        const Points result = flowed(both, sweep_options(laplacian, 2));
        const Points offset_first = both.vertices.topRows(first.n_vertices());
        PolygonMesh alone = first;
        alone.vertices = offset_first;
        FlowOptions options = sweep_options(laplacian, 1);
        // That of both.
        options.uniform_edge = mean_edge_length(both, both.vertices);
        CHECK(largest_difference(result.topRows(first.n_vertices()), flowed(alone, options)) <= 1e-12);
    }
}

TEST_CASE("the flow shrinks the height of a bump, decomposed and not, to about the same")
{
    for (const PolygonMesh& mesh : height_fields())
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::PtackovaVelho}) {
            CAPTURE(name_of(laplacian));
            const double before = mesh.vertices.col(2).norm();
            const double undecomposed = flowed(mesh, sweep_options(laplacian, 1)).col(2).norm();
            const double decomposed = flowed(mesh, sweep_options(laplacian, 4)).col(2).norm();
            CHECK(undecomposed < 0.8 * before);
            CHECK(decomposed == test::relative(undecomposed, 0.05));
        }
}
