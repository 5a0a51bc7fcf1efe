#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/choose_tolerance.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/common/meshes.h"

using namespace seamflow;

namespace {

/// @param step in squared mean edge lengths.
FlowOptions step_options(const PolygonMesh& mesh, Laplacian laplacian, double step)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = step * mean_edge_length(mesh) * mean_edge_length(mesh);
    return options;
}

}  // namespace

TEST_CASE("a tolerance that is asked for is kept, whatever the mesh")
{
    const PolygonMesh mesh = make_triangles(500);
    FlowOptions options = step_options(mesh, Laplacian::Fujiwara, 1.0);
    options.accuracy.tolerance = 1e-5;
    CHECK(choose_tolerance(mesh, size_of(mesh), options).tolerance == 1e-5);
    CHECK(choose_tolerance(mesh, size_of(mesh), options).reason.empty());
}

TEST_CASE("steps are converged where they are long, sub-meshes narrow, or polygons have Δ_A")
{
    const PolygonMesh triangles = make_triangles(10000);
    const PolygonMesh quads = make_quads(10000);
    const auto converges = [](const PolygonMesh& mesh, const FlowOptions& options) {
        const ToleranceChoice choice = choose_tolerance(mesh, size_of(mesh), options);
        CHECK(choice.tolerance.has_value() == !choice.reason.empty());
        return choice.tolerance.has_value();
    };
    CHECK_FALSE(converges(triangles, step_options(triangles, Laplacian::Fujiwara, 5.0)));
    CHECK_FALSE(converges(triangles, step_options(triangles, Laplacian::AlexaWardetzky, 5.0)));
    CHECK(converges(triangles, step_options(triangles, Laplacian::Fujiwara, 50.0)));
    CHECK(converges(triangles, step_options(triangles, Laplacian::AlexaWardetzky, 50.0)));
    CHECK(converges(quads, step_options(quads, Laplacian::AlexaWardetzky, 1.0)));
    CHECK_FALSE(converges(quads, step_options(quads, Laplacian::Fujiwara, 1.0)));
    CHECK_FALSE(converges(quads, step_options(quads, Laplacian::PtackovaVelho, 50.0)));

    FlowOptions narrow = step_options(triangles, Laplacian::Fujiwara, 5.0);
    narrow.cut.subdomains = 100;
    CHECK(converges(triangles, narrow));
    narrow.cut.subdomains = 2;
    CHECK_FALSE(converges(triangles, narrow));
    const PolygonMesh small = make_triangles(2000);
    CHECK_FALSE(converges(small, step_options(small, Laplacian::Fujiwara, 50.0)));
    CHECK_FALSE(converges(PolygonMesh{}, step_options(small, Laplacian::Fujiwara, 50.0)));
}

TEST_CASE("options that speak of sweeps get sweeps")
{
    const PolygonMesh mesh = make_triangles(10000);
    const FlowOptions long_steps = step_options(mesh, Laplacian::Fujiwara, 50.0);
    REQUIRE(choose_tolerance(mesh, size_of(mesh), long_steps).tolerance);
    const auto sweeps_with = [&](auto change) {
        FlowOptions options = long_steps;
        change(options);
        return !choose_tolerance(mesh, size_of(mesh), options).tolerance;
    };
    CHECK(sweeps_with([](FlowOptions& o) { o.accuracy.approach = Approach::Sweep; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.conditions = Conditions::Schwarz; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.transmission = Transmission::Derivative; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.p = 1.0; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.correction = Correction::None; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.coloring = Coloring::Label; }));
    CHECK(sweeps_with([](FlowOptions& o) { o.scheme = Scheme::ExplicitEuler; }));
    CHECK_FALSE(sweeps_with([](FlowOptions& o) { o.resources.memory_limit = 1'000'000'000; }));
    FlowOptions plain = FlowOptions::plain();
    plain.time_step = long_steps.time_step;
    CHECK_FALSE(choose_tolerance(mesh, size_of(mesh), plain).tolerance);
}

TEST_CASE("the report has the tolerance that was chosen, and says why")
{
    const PolygonMesh mesh = make_triangles(10000);
    const auto report_of = [&](FlowOptions options) {
        PolygonMesh moved = mesh;
        return mean_curvature_flow(moved, options);
    };
    const FlowReport converged = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 50.0));
    REQUIRE(converged.tolerance);
    CHECK(converged.steps.back().residual.value() <= *converged.tolerance);
    CHECK(converged.remarks.front().find("Steps are converged") == 0);
    const FlowReport swept = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 1.0));
    CHECK_FALSE(swept.tolerance);
    CHECK_FALSE(swept.steps.back().residual);
    // So long a step that the mesh is not cut.
    const FlowReport whole = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 5000.0));
    CHECK(whole.subdomains == 1);
    CHECK_FALSE(whole.tolerance);
}
