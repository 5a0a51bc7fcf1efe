#include <memory>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/setup/cost_model.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "solvers/systems/whole_mesh_system.h"
#include "tests/support/collapsing_flow.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::collapsing_flow;

namespace {

/// The first step without iterations, from 1; 0: none.
int first_without_iterations(const FlowReport& report)
{
    for (std::size_t i = 0; i < report.steps.size(); ++i)
        if (report.steps[i].iterations == 0)
            return static_cast<int>(i) + 1;
    return 0;
}

}  // namespace

TEST_CASE("where edges collapse, conjugate gradients begin with the solution by factors, and end there")
{
    const PolygonMesh mesh = make_mixed_polygons(10'000);
    const FlowOptions options = collapsing_flow(mesh);
    PolygonMesh moved = mesh;
    const FlowReport report = mean_curvature_flow(moved, options);
    REQUIRE(report.convergence.approach == Approach::ConjugateGradients);
    const int first = first_without_iterations(report);
    REQUIRE(first >= 4);
    for (std::size_t i = 0; i < report.steps.size(); ++i) {
        CHECK((*report.steps[i].iterations == 0) == (i + 1 >= usize(first)));
        CHECK(*report.steps[i].residual <= *report.convergence.tolerance);
    }
    REQUIRE(report.choices.size() == 2);
    CHECK(sentence(report.choices.back()).starts_with("From step " + std::to_string(first)));

    FlowOptions exact = options;
    exact.accuracy.approach = Approach::Undecomposed;
    CHECK(vertex_distance(mesh, test::flowed(mesh, exact), moved.vertices).max <
          report.steps.back().estimated_v_max.value() * mean_edge_length(mesh));

    FlowOptions asked_for = options;
    asked_for.accuracy.approach = Approach::ConjugateGradients;
    PolygonMesh by_gradients = mesh;
    const FlowReport other = mean_curvature_flow(by_gradients, asked_for);
    CHECK(other.steps.back().iterations > 10 * *other.steps.front().iterations);
}

TEST_CASE("such a flow has the same bits on any number of threads, and resumed after any step")
{
    const PolygonMesh mesh = make_mixed_polygons(10'000);
    FlowOptions options = collapsing_flow(mesh);
    std::vector<std::shared_ptr<const FlowState>> states;
    PolygonMesh moved = mesh;
    options.resources.threads = 3;
    const FlowReport report =
        mean_curvature_flow(moved, options, [&](const StepState& now) { states.push_back(now.capture()); });
    options.resources.threads = 1;
    CHECK(test::same_bits(test::flowed(mesh, options), moved.vertices));
    for (const auto& state : states) {
        PolygonMesh resumed = mesh;
        const FlowReport of_resumed = mean_curvature_flow(resumed, options, {}, {.resume = state});
        CHECK(test::same_bits(resumed.vertices, moved.vertices));
        CHECK(of_resumed.choices == report.choices);
        CHECK(of_resumed.steps.back().estimated_v_max == report.steps.back().estimated_v_max);
    }
}

TEST_CASE("iterations that stay as they are need no factors")
{
    PolygonMesh mesh = make_triangles(10'000);
    const FlowReport report = mean_curvature_flow(mesh, collapsing_flow(mesh));
    REQUIRE(report.convergence.approach == Approach::ConjugateGradients);
    CHECK(first_without_iterations(report) == 0);
    CHECK(report.choices.size() == 1);
}

TEST_CASE("iterations that grow are worth factors, where these take no more memory than there is")
{
    FlowSize size{.vertices = 10'000, .rows = {.length = 6.0, .stiffness = 1.0}, .time_step = 1.0, .steps = 1};
    CHECK(pays_to_factorise(size, {.before = 20, .last = 40, .most = 1000}));
    // The same number of iterations, but growing no more, or no further than to the most.
    CHECK_FALSE(pays_to_factorise(size, {.before = 30, .last = 30, .most = 1000}));
    CHECK_FALSE(pays_to_factorise(size, {.before = 15, .last = 30, .most = 30}));
    CHECK(pays_to_factorise(size, {.before = 400, .last = 400, .most = 1000}));
    CHECK_FALSE(pays_to_factorise(size, {.before = 40, .last = 5, .most = 1000}));
    size.vertices = 10'000'000;
    CHECK_FALSE(pays_to_factorise(size, {.before = 500, .last = 1000, .most = 1000}));
}

TEST_CASE("a flow that is resumed for more steps, or goes on beyond those expected, switches at the same step")
{
    const PolygonMesh mesh = make_mixed_polygons(10'000);
    FlowOptions options = collapsing_flow(mesh);
    const Points expected = test::flowed(mesh, options);
    options.steps = 3;
    FlowControl control;
    PolygonMesh moved = mesh;
    Flow flow(moved, options, [&](const StepState& now) {
        if (now.step == 3)
            control.resume = now.capture();
    });
    flow.step(7);
    CHECK(test::same_bits(moved.vertices, expected));
    options.steps = 7;
    PolygonMesh resumed = mesh;
    mean_curvature_flow(resumed, options, {}, control);
    CHECK(test::same_bits(resumed.vertices, expected));
    // Ordinary steps need no factors, however many there are.
    PolygonMesh regular = make_triangles(10'000);
    FlowOptions one = collapsing_flow(regular);
    one.steps = 1;
    Flow longer(regular, one);
    longer.step(6);
    CHECK(first_without_iterations(longer.report()) == 0);
}

TEST_CASE("a step by conjugate gradients begins with a guess that is nearer than the positions before")
{
    const PolygonMesh mesh = make_noisy_sphere(3000);
    const Topology topology = make_topology(mesh);
    WholeMeshSystem system(mesh, topology, {Laplacian::AlexaWardetzky}, FlowTerms{}, run_serially);
    Points exact = mesh.vertices;
    Points without = mesh.vertices;
    Points after = mesh.vertices;
    const double dt = 0.01;
    system.step(mesh.vertices, dt, {1e-11, 1000}, exact, run_serially);
    const auto plain = system.step(mesh.vertices, dt, {1e-6, 1000}, without, run_serially);
    const auto from = [&](const Points& guess) {
        return system.step(mesh.vertices, dt, {1e-6, 1000}, after, run_serially, &guess);
    };
    const auto from_exact = from(exact);
    CHECK(from_exact.iterations == 0);
    CHECK(from_exact.residual < 1e-10);
    CHECK(test::same_bits(after, exact));

    const Points near = exact + 1e-3 * (mesh.vertices - exact);
    const auto from_near = from(near);
    CHECK(from_near.iterations > 0);
    CHECK(from_near.iterations < plain.iterations);
    CHECK(from_near.residual <= 1e-6);
    CHECK(test::largest_difference(after, exact) < 1e-5);

    const Points far = exact + 100.0 * (exact - mesh.vertices);
    const auto from_far = from(far);
    CHECK(from_far.iterations == plain.iterations);
    CHECK(test::largest_difference(after, without) < 1e-12);
}
