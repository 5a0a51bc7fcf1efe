#include <algorithm>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

/// @param step_in_edges dt in squared mean edge lengths.
FlowOptions estimated_options(const PolygonMesh& mesh, Laplacian laplacian, double step_in_edges, Index subdomains)
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.laplacian = laplacian;
    options.time_step = step_in_edges * mean_edge_length(mesh) * mean_edge_length(mesh);
    options.steps = 5;
    options.cut.subdomains = subdomains;
    options.report.reference = true;
    return options;
}

FlowReport report_of(PolygonMesh mesh, const FlowOptions& options)
{
    return mean_curvature_flow(mesh, options);
}

void require_within(double factor, const FlowReport& report)
{
    for (const StepReport& step : report.steps) {
        const double truth = step.distance->max / step.distance->mean_edge;
        CAPTURE(truth);
        CHECK(step.estimated_v_max.value() < factor * truth);
        CHECK(step.estimated_v_max.value() > truth / factor);
    }
}

}  // namespace

TEST_CASE("the estimate is within a factor of 3 of the distance to the undecomposed flow")
{
    for (const PolygonMesh& mesh : test::height_fields(1600))
        for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
            for (const double step : {3.0, 10.0})
                for (const Index subdomains : {4, 12}) {
                    CAPTURE(mesh.n_faces());
                    CAPTURE(name_of(laplacian));
                    CAPTURE(step);
                    CAPTURE(subdomains);
                    require_within(3.0, report_of(mesh, estimated_options(mesh, laplacian, step, subdomains)));
                }
}

TEST_CASE("Δ_P, whose flow is not always smooth, after one step")
{
    for (const PolygonMesh& mesh : test::height_fields(1600)) {
        CAPTURE(mesh.n_faces());
        FlowOptions options = estimated_options(mesh, Laplacian::PtackovaVelho, 5.0, 6);
        options.steps = 1;
        require_within(3.0, report_of(mesh, options));
    }
}

TEST_CASE("the other conditions")
{
    const PolygonMesh mesh = make_triangles(1600);
    for (const Conditions conditions : {Conditions::AdaptedVentcell, Conditions::Robin, Conditions::Ventcell}) {
        FlowOptions options = estimated_options(mesh, Laplacian::AlexaWardetzky, 5.0, 6);
        options.interface.conditions = conditions;
        if (conditions != Conditions::Robin)
            options.interface.q = 0.1;
        options.steps = 2;
        require_within(3.0, report_of(mesh, options));
    }
    FlowOptions plain = FlowOptions::plain();
    const FlowOptions of_mesh = estimated_options(mesh, Laplacian::Fujiwara, 5.0, 6);
    plain.time_step = of_mesh.time_step;
    plain.cut.subdomains = 6;
    plain.steps = 3;
    plain.report.reference = true;
    require_within(3.0, report_of(mesh, plain));
}

TEST_CASE("where sweeps err little, what the corrections of the interface have done")
{
    const PolygonMesh mesh = make_mixed_polygons(1600);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky})
        for (const double step : {0.05, 0.2}) {
            CAPTURE(name_of(laplacian));
            CAPTURE(step);
            FlowOptions options = estimated_options(mesh, laplacian, step, 6);
            options.steps = 3;
            require_within(3.0, report_of(mesh, options));
        }
}

TEST_CASE("with an attachment, which pulls towards the first positions in every step")
{
    const PolygonMesh mesh = make_triangles(1600);
    const double edge = mean_edge_length(mesh);
    for (const double pull : {0.3, 3.0}) {
        CAPTURE(pull);
        FlowOptions options = estimated_options(mesh, Laplacian::AlexaWardetzky, 5.0, 6);
        options.motion.attachment = pull / (edge * edge);
        require_within(3.0, report_of(mesh, options));
    }
}

TEST_CASE("undecomposed the estimate is zero")
{
    for (const Laplacian laplacian : test::all_laplacians)
        for (const StepReport& step :
             report_of(make_quads(400), estimated_options(make_quads(400), laplacian, 5.0, 1)).steps)
            CHECK(step.estimated_v_max == 0.0);
}

TEST_CASE("where there is nothing to estimate from, there is no estimate")
{
    const PolygonMesh mesh = make_quads(900);
    FlowOptions schwarz = estimated_options(mesh, Laplacian::Fujiwara, 1.0, 4);
    schwarz.interface.conditions = Conditions::Schwarz;
    CHECK_FALSE(report_of(mesh, schwarz).steps.back().estimated_v_max);
    FlowOptions explicit_steps = estimated_options(mesh, Laplacian::Fujiwara, 0.1, 0);
    explicit_steps.scheme = Scheme::ExplicitEuler;
    CHECK_FALSE(report_of(mesh, explicit_steps).steps.back().estimated_v_max);
}

TEST_CASE("an estimate above a mean edge length is spoken of")
{
    const PolygonMesh mesh = make_triangles(1600);
    CHECK(test::count_with(report_of(mesh, estimated_options(mesh, Laplacian::AlexaWardetzky, 1.0, 2)).remarks,
                           "by estimate") == 0);
    const FlowReport report = report_of(mesh, estimated_options(mesh, Laplacian::AlexaWardetzky, 100.0, 20));
    CHECK(report.steps.back().estimated_v_max > 1.0);
    CHECK(test::count_with(report.remarks, "by estimate") == 1);
}
