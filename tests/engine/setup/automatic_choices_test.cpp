#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/resolved_options.h"
#include "engine/state/flow_state.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

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
    options.accuracy.approach = Approach::Decomposed;
    PolygonMesh mesh = make_quads(8000);
    CHECK(mean_curvature_flow(mesh, options).cut.n_sub_meshes() == 3);
    options.laplacian = Laplacian::PtackovaVelho;
    CHECK(mean_curvature_flow(mesh, options).cut.n_sub_meshes() == mesh.n_vertices() / 1000);
}

TEST_CASE("sub-meshes of converged steps may be narrower")
{
    const PolygonMesh mesh = make_quads(50000);
    CHECK(choose_subdomains(size_of(mesh), 1e-8, needs_of_converged_steps).count == mesh.n_vertices() / 2000);
    const Index count = choose_subdomains(size_of(mesh), 2e-2, needs_of_converged_steps).count;
    CHECK(width_in_diffusion_lengths(total_area(mesh), count, 2e-2) >= needs_of_converged_steps.width);
    CHECK(width_in_diffusion_lengths(total_area(mesh), count + 1, 2e-2) < needs_of_converged_steps.width);
}

TEST_CASE("the choice and its reason are in the report, and so is a warning of narrow sub-meshes")
{
    FlowOptions options;
    options.time_step = 1e-6;
    options.accuracy.approach = Approach::Decomposed;
    PolygonMesh mesh = make_quads(8000);
    const FlowReport chosen = mean_curvature_flow(mesh, options);
    CHECK(chosen.cut.n_sub_meshes() == 3);
    REQUIRE(chosen.choices.size() == 1);
    CHECK(sentence(chosen.choices[0]).find("Cut into 3 sub-meshes") == 0);

    options.cut.subdomains = 40;
    options.time_step = 1e-3;
    const FlowReport narrow = mean_curvature_flow(mesh, options);
    REQUIRE(narrow.choices.size() == 1);
    CHECK(sentence(narrow.choices[0]).find("narrow") != std::string::npos);
}

TEST_CASE("converged steps of a Laplacian without symmetry are those of the whole mesh, and one sentence says so")
{
    for (const PolygonMesh& mesh : {make_triangles(900), make_hexagons(900), make_cylinder(900)}) {
        FlowOptions options = step_options(mesh, Laplacian::PtackovaVelho, 3.0);
        options.steps = 2;
        options.accuracy.approach = Approach::Undecomposed;
        const Points expected = test::flowed(mesh, options);
        options.accuracy.approach = Approach::Converged;
        options.cut.subdomains = 7;
        PolygonMesh moved = mesh;
        const FlowReport report = mean_curvature_flow(moved, options);
        CHECK(moved.vertices.cwiseEqual(expected).all());
        CHECK(report.convergence.approach == Approach::Undecomposed);
        REQUIRE(report.choices.size() == 1);
        CHECK(sentence(report.choices[0]) ==
              "The whole mesh is solved at once by one factorisation. Steps of Laplacians without "
              "symmetry converge in no other way.");
    }
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
        options.accuracy.approach = Approach::Decomposed;
        return mean_curvature_flow(moved, options);
    };
    const FlowReport converged = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 50.0));
    REQUIRE(converged.convergence.tolerance);
    CHECK(converged.steps.back().residual.value() <= *converged.convergence.tolerance);
    CHECK(sentence(converged.choices.front()).find("Sub-meshes are solved until they agree") == 0);
    const FlowReport swept = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 1.0));
    CHECK_FALSE(swept.convergence.tolerance);
    CHECK_FALSE(swept.steps.back().residual);
    // So long a step that the mesh is not cut.
    const FlowReport whole = report_of(step_options(mesh, Laplacian::AlexaWardetzky, 5000.0));
    CHECK(whole.cut.n_sub_meshes() == 1);
    CHECK_FALSE(whole.convergence.tolerance);
}

TEST_CASE("the number of iterations of conjugate gradients is foreseen within a factor of two")
{
    for (const PolygonMesh& mesh :
         {make_triangles(10000), make_hexagons(10000), make_mixed_polygons(10000), make_noisy_sphere(10000)})
        for (const Laplacian laplacian : test::symmetric_laplacians)
            for (const double step : {1.0, 5.0, 50.0})
                for (const double tolerance : {1e-2, 1e-4}) {
                    FlowOptions options = step_options(mesh, laplacian, step);
                    options.accuracy = {.tolerance = tolerance, .approach = Approach::ConjugateGradients};
                    options.uniform_edge = resolved(options, mesh).uniform_edge;
                    PolygonMesh moved = mesh;
                    const int taken = mean_curvature_flow(moved, options).steps[0].iterations.value();
                    const FlowSize size{.vertices = mesh.n_vertices(),
                                        .rows = average_rows(mesh, make_topology(mesh), laplacian_of(options)),
                                        .time_step = options.time_step};
                    const double foreseen = predicted_iterations(size, tolerance);
                    CHECK(foreseen < 2.0 * taken + 1.0);
                    CHECK(foreseen > 0.5 * taken - 1.0);
                }
}

TEST_CASE("what costs least is chosen where nothing is said of sub-meshes, and as asked where there is")
{
    const PolygonMesh mesh = make_triangles(20000);
    const Topology topology = make_topology(mesh);
    const auto choice_of = [&](const FlowOptions& options) {
        return choose_approach(mesh, topology, size_of(mesh), options);
    };
    const auto approach_of = [&](double step, int steps, Laplacian laplacian = Laplacian::Fujiwara) {
        FlowOptions options = step_options(mesh, laplacian, step);
        options.steps = steps;
        const ApproachChoice choice = choice_of(options);
        CHECK(choice.reason.empty() == (choice.approach == Approach::Sweep));
        CHECK(choice.tolerance.has_value() ==
              (choice.approach == Approach::Converged || choice.approach == Approach::ConjugateGradients));
        for (const PredictedCost& cost : choice.costs)
            CHECK(cost.of(steps) >= choice.costs.front().of(steps));
        return choice.approach;
    };
    CHECK(approach_of(1.0, 1) == Approach::ConjugateGradients);
    CHECK(approach_of(5.0, 10) == Approach::ConjugateGradients);
    CHECK(approach_of(5.0, 1, Laplacian::AlexaWardetzky) == Approach::ConjugateGradients);
    CHECK(approach_of(500.0, 1) == Approach::Undecomposed);
    CHECK(approach_of(200.0, 1000) == Approach::Converged);
    CHECK(approach_of(5.0, 1, Laplacian::PtackovaVelho) == Approach::Sweep);

    const auto with = [&](auto change) {
        FlowOptions options = step_options(mesh, Laplacian::Fujiwara, 1.0);
        change(options);
        const ApproachChoice choice = choice_of(options);
        CHECK(choice.costs.empty());
        return choice.approach;
    };
    CHECK(with([](FlowOptions& o) { o.accuracy.approach = Approach::Decomposed; }) == Approach::Sweep);
    CHECK(with([](FlowOptions& o) { o.accuracy.approach = Approach::Undecomposed; }) == Approach::Undecomposed);
    CHECK(with([](FlowOptions& o) { o.cut.subdomains = 4; }) == Approach::Sweep);
    CHECK(with([&](FlowOptions& o) { o.cut.labels.assign(mesh.n_faces(), 0); }) == Approach::Sweep);
    CHECK(with([](FlowOptions& o) { o.interface.colouring = Colouring::Label; }) == Approach::Sweep);
    CHECK(with([](FlowOptions& o) { o.resources.factorisation = Factorisation::Own; }) == Approach::Sweep);
    CHECK(with([](FlowOptions& o) { o.scheme = Scheme::ExplicitEuler; }) == Approach::Sweep);
    CHECK(with([](FlowOptions& o) { o.cut.subdomains = 4, o.accuracy.tolerance = 1e-8; }) == Approach::Converged);
}

TEST_CASE("the number of cores to tune for decides, that of threads does not")
{
    const PolygonMesh mesh = make_triangles(20000);
    const Topology topology = make_topology(mesh);
    FlowOptions options = step_options(mesh, Laplacian::Fujiwara, 500.0);
    options.steps = 1;
    const auto choice_for = [&](int cores, int threads) {
        options.resources.tune_for = cores;
        options.resources.threads = threads;
        return choose_approach(mesh, topology, size_of(mesh), options);
    };
    CHECK(choice_for(2, 2).approach == Approach::Undecomposed);
    CHECK(choice_for(2, 16).approach == Approach::Undecomposed);
    CHECK(choice_for(16, 2).approach != Approach::Undecomposed);
    // One factor of the whole mesh is of little use to further cores; all else is, up to what memory feeds.
    const auto cost_of = [](const ApproachChoice& choice, Approach approach) {
        return *std::ranges::find(choice.costs, approach, &PredictedCost::approach);
    };
    const auto cost = [&](Approach approach, int cores) { return cost_of(choice_for(cores, 1), approach); };
    CHECK(cost(Approach::Undecomposed, 64).step > 0.2 * cost(Approach::Undecomposed, 1).step);
    CHECK(cost(Approach::Undecomposed, 64).step < 0.5 * cost(Approach::Undecomposed, 1).step);
    for (const Approach approach : {Approach::Converged, Approach::ConjugateGradients}) {
        CHECK(cost(approach, 1).step > 1.8 * cost(approach, 2).step);
        CHECK(cost(approach, 2).step > 4.0 * cost(approach, 16).step);
        CHECK(cost(approach, 2).setup > 1.5 * cost(approach, 16).setup);
    }
    CHECK(cost(Approach::ConjugateGradients, 1000).step > 0.8 * cost(Approach::ConjugateGradients, 64).step);
    CHECK(cost(Approach::Converged, 1000).step < 0.7 * cost(Approach::Converged, 64).step);
}

TEST_CASE("conjugate gradients are not chosen where their iterations would not do")
{
    const PolygonMesh mesh = make_triangles(20000);
    const Topology topology = make_topology(mesh);
    FlowOptions options = step_options(mesh, Laplacian::Fujiwara, 5.0);
    REQUIRE(choose_approach(mesh, topology, size_of(mesh), options).approach == Approach::ConjugateGradients);
    options.accuracy.converge_iterations = 20;
    CHECK(choose_approach(mesh, topology, size_of(mesh), options).approach != Approach::ConjugateGradients);
}

TEST_CASE("what was chosen for few steps stays for more")
{
    const PolygonMesh mesh = make_triangles(20000);
    FlowOptions options = step_options(mesh, Laplacian::Fujiwara, 200.0);
    options.steps = 1;
    std::shared_ptr<const FlowState> state;
    PolygonMesh moved = mesh;
    const FlowReport first = mean_curvature_flow(moved, options, [&](const StepState& now) { state = now.capture(); });
    REQUIRE(first.convergence.approach == Approach::Undecomposed);
    options.steps = 1000;
    CHECK(choose_approach(mesh, make_topology(mesh), size_of(mesh), options).approach == Approach::Converged);
    CHECK(choose_approach(mesh, make_topology(mesh), size_of(mesh), options, state->approach).approach ==
          Approach::Undecomposed);
    options.steps = 2;
    PolygonMesh resumed = mesh;
    mean_curvature_flow(resumed, options, {}, {.stop = {}, .on_progress = {}, .resume = state});
    FlowOptions undecomposed = options;
    undecomposed.accuracy.approach = Approach::Undecomposed;
    CHECK(test::same_bits(resumed.vertices, test::flowed(mesh, undecomposed)));
}

TEST_CASE("on faces of many sides the Laplacian of two rings takes the undecomposed step, not a sweep")
{
    for (const Index sides : {100, 400}) {
        CAPTURE(sides);
        PolygonMesh prism;
        prism.vertices.resize(6 * sides, 3);
        for (Index ring = 0; ring < 6; ++ring)
            for (Index i = 0; i < sides; ++i) {
                const double angle = 2.0 * std::numbers::pi * i / sides;
                prism.vertices.row(ring * sides + i) << std::cos(angle), std::sin(angle), 0.2 * ring;
            }
        std::vector<Index> bottom;
        std::vector<Index> top;
        for (Index i = 0; i < sides; ++i) {
            bottom.push_back(sides - 1 - i);
            top.push_back(5 * sides + i);
            for (Index ring = 0; ring < 5; ++ring)
                prism.add_face(std::array{ring * sides + i, ring * sides + (i + 1) % sides,
                                          (ring + 1) * sides + (i + 1) % sides, (ring + 1) * sides + i});
        }
        prism.add_face(bottom);
        prism.add_face(top);
        FlowOptions options;
        options.laplacian = Laplacian::PtackovaVelho;
        options.time_step = 1e-4;
        options.report.reference = true;
        PolygonMesh mesh = prism;
        const FlowReport report = mean_curvature_flow(mesh, options);
        CHECK(report.convergence.approach != Approach::Sweep);
        CHECK(report.steps.front().distance.value().max < 0.01);
        const Points rings = mesh.vertices - prism.vertices;
        CHECK(rings.rowwise().norm().maxCoeff() < 0.01);
    }
}
