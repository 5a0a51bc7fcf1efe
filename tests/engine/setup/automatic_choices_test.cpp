#include <cmath>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/automatic_choices.h"
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

TEST_CASE("small meshes and large time steps are not cut")
{
    CHECK(choose_subdomains(size_of(make_quads(1000)), 1e-8, needs_of_sweeps).count == 1);
    CHECK(choose_subdomains(size_of(make_quads(20000)), 1.0, needs_of_sweeps).count == 1);
    CHECK(choose_subdomains(size_of(PolygonMesh{}), 1.0, needs_of_sweeps).count == 1);
}

TEST_CASE("sub-meshes get a few thousand vertices each, but are no narrower than 10 √dt")
{
    const PolygonMesh mesh = make_quads(50000);
    const SubdomainChoice by_cost = choose_subdomains(size_of(mesh), 1e-8, needs_of_sweeps);
    CHECK(by_cost.count == mesh.n_vertices() / 2500);
    const SubdomainChoice by_width = choose_subdomains(size_of(mesh), 1e-3, needs_of_sweeps);
    CHECK(by_width.count > 1);
    CHECK(by_width.count < by_cost.count);
    CHECK(width_in_diffusion_lengths(total_area(mesh), by_width.count, 1e-3) >= needs_of_sweeps.width);
    CHECK(width_in_diffusion_lengths(total_area(mesh), by_width.count + 1, 1e-3) < needs_of_sweeps.width);
    CHECK(by_width.reason != by_cost.reason);
}

TEST_CASE("without symmetry a sweep has smaller sub-meshes")
{
    FlowOptions options;
    options.time_step = 1e-6;
    PolygonMesh mesh = make_quads(8000);
    CHECK(mean_curvature_flow(mesh, options).cut.n_sub_meshes() == 3);
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK(mean_curvature_flow(mesh, options).cut.n_sub_meshes() == mesh.n_vertices() / 1000);
}

TEST_CASE("sub-meshes of converged steps may be narrower, and without symmetry are smaller")
{
    const PolygonMesh mesh = make_quads(50000);
    CHECK(choose_subdomains(size_of(mesh), 1e-8, needs_of_converged_steps).count == mesh.n_vertices() / 2000);
    CHECK(choose_subdomains(size_of(mesh), 1e-8, needs_of_krylov_steps).count == mesh.n_vertices() / 1000);
    const Index count = choose_subdomains(size_of(mesh), 2e-2, needs_of_converged_steps).count;
    CHECK(width_in_diffusion_lengths(total_area(mesh), count, 2e-2) >= needs_of_converged_steps.width);
    CHECK(width_in_diffusion_lengths(total_area(mesh), count + 1, 2e-2) < needs_of_converged_steps.width);
}

TEST_CASE("the choice and its reason are in the report, and so is a warning of narrow sub-meshes")
{
    FlowOptions options;
    options.time_step = 1e-6;
    PolygonMesh mesh = make_quads(8000);
    const FlowReport chosen = mean_curvature_flow(mesh, options);
    CHECK(chosen.cut.n_sub_meshes() == 3);
    REQUIRE(chosen.remarks.size() == 1);
    CHECK(chosen.remarks[0].find("3 sub-meshes chosen") == 0);

    options.cut.subdomains = 40;
    options.time_step = 1e-3;
    const FlowReport narrow = mean_curvature_flow(mesh, options);
    REQUIRE(narrow.remarks.size() == 1);
    CHECK(narrow.remarks[0].find("narrow") != std::string::npos);
}

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
    CHECK(sweeps_with([](FlowOptions& o) { o.interface.colouring = Colouring::Label; }));
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
    REQUIRE(converged.convergence.tolerance);
    CHECK(converged.steps.back().residual.value() <= *converged.convergence.tolerance);
    CHECK(converged.remarks.front().find("Steps are converged") == 0);
    const FlowReport swept = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 1.0));
    CHECK_FALSE(swept.convergence.tolerance);
    CHECK_FALSE(swept.steps.back().residual);
    // So long a step that the mesh is not cut.
    const FlowReport whole = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 5000.0));
    CHECK(whole.cut.n_sub_meshes() == 1);
    CHECK_FALSE(whole.convergence.tolerance);
}
