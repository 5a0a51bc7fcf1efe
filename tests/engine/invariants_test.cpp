#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"

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

TEST_CASE("a flat mesh stays flat, however steps are taken")
{
    for (const PolygonMesh& mesh : height_fields(600))
        for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
            CAPTURE(kind.name);
            const Points result = flowed(flat(mesh), kind.options);
            CHECK(result.allFinite());
            CHECK(result.col(2).cwiseAbs().maxCoeff() == 0.0);
        }
}

TEST_CASE("with Alexa-Wardetzky a flat mesh of triangles does not move at all without the correction")
{
    const PolygonMesh mesh = flat(make_triangles(900));
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Schwarz})
        for (const Index subdomains : {1, 2, 5, 16}) {
            FlowOptions options = sweep_options(Laplacian::AlexaWardetzky, subdomains);
            options.interface.conditions = conditions;
            options.interface.correction = Correction::None;
            CHECK(largest_difference(flowed(mesh, options), mesh.vertices) <= 1e-12);
        }
}

TEST_CASE("in one sub-mesh every condition gives the undecomposed flow to the bit, with no gap")
{
    const PolygonMesh mesh = make_mixed_polygons(900);
    for (const Laplacian laplacian : all_laplacians)
        for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::AdaptedVentcell, Conditions::Robin,
                                            Conditions::Ventcell, Conditions::Schwarz}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(static_cast<int>(conditions));
            FlowOptions options = sweep_options(laplacian, 1);
            options.interface.conditions = conditions;
            if (conditions == Conditions::AdaptedVentcell || conditions == Conditions::Ventcell)
                options.interface.q = 0.2;
            options.report.reference = true;
            options.report.keep_gaps = is_classical(conditions);
            PolygonMesh moved = mesh;
            const FlowReport report = mean_curvature_flow(moved, options);
            CHECK(report.cut.n_colours() == 1);
            CHECK(report.steps.back().distance->max == 0.0);
            if (!is_classical(conditions))
                continue;
            CHECK(report.steps.back().gap->max == 0.0);
            CHECK(test::same_bits(report.separated->vertices, moved.vertices));
            CHECK(report.separated->face_vertices == mesh.face_vertices);
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
