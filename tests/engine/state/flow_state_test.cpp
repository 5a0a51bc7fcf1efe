#include <limits>
#include <memory>

#include <doctest/doctest.h>

#include "engine/state/checkpoint.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/option_cases.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_meshes.h"
#include "tests/support/writings.h"

using namespace seamflow;

namespace {

/// The result of a flow and what it reported.
struct ResultOfRun {
    Points positions;
    SmoothReport report;
};

ResultOfRun run(PolygonMesh mesh, const AllOptions& options, std::shared_ptr<const FlowState> resume = nullptr)
{
    SmoothReport report = smooth_surface(mesh, options, {}, {.stop = {}, .on_progress = {}, .resume = resume});
    return {mesh.vertices, std::move(report)};
}

/// The state after a step, by way of a file.
std::shared_ptr<const FlowState> state_after(int step, PolygonMesh mesh, AllOptions options)
{
    const test::TemporaryDirectory directory;
    options.steps = step;
    smooth_surface(mesh, options, [&](const StepState& state) {
        if (state.step == step)
            write_checkpoint(directory / "state", state.capture());
    });
    return std::make_shared<const FlowState>(read_checkpoint(directory / "state"));
}

void check_same(const LengthStatistics& a, const LengthStatistics& b)
{
    CHECK(a.mean == b.mean);
    CHECK(a.rms == b.rms);
    CHECK(a.max == b.max);
}

void check_same(const StepReport& a, const StepReport& b)
{
    CHECK(a.max_mean_curvature_before == b.max_mean_curvature_before);
    CHECK(a.max_mean_curvature_after == b.max_mean_curvature_after);
    check_same(a.displacement.tangential, b.displacement.tangential);
    check_same(a.displacement.normal, b.displacement.normal);
    REQUIRE(a.gap.has_value() == b.gap.has_value());
    if (a.gap)
        check_same(*a.gap, *b.gap);
    CHECK(a.iterations == b.iterations);
    CHECK(a.residual == b.residual);
    CHECK(a.estimated_v_max == b.estimated_v_max);
    REQUIRE(a.distance.has_value() == b.distance.has_value());
    if (a.distance)
        CHECK(a.distance->max == b.distance->max);
}

/// Going on after each step gives the same bits and the same report.
void check_resumed(const PolygonMesh& mesh, const AllOptions& options)
{
    const ResultOfRun whole = run(mesh, options);
    for (int step = 1; step <= options.steps; ++step) {
        CAPTURE(step);
        AllOptions other_threads = options;
        other_threads.resources.threads = 3;
        const auto state = state_after(step, mesh, other_threads);
        CHECK(state->n_steps() == step);
        const ResultOfRun resumed = run(mesh, options, state);
        CHECK(test::same_bits(resumed.positions, whole.positions));
        REQUIRE(resumed.report.steps.size() == whole.report.steps.size());
        for (std::size_t i = 0; i < whole.report.steps.size(); ++i)
            check_same(resumed.report.steps[i], whole.report.steps[i]);
        REQUIRE(resumed.report.displacement.has_value() == options.report.measures);
        if (options.report.measures) {
            check_same(resumed.report.displacement->path.tangential, whole.report.displacement->path.tangential);
            check_same(resumed.report.displacement->drift, whole.report.displacement->drift);
        }
        CHECK(resumed.report.choices == whole.report.choices);
        CHECK(resumed.report.noise.has_value() == whole.report.noise.has_value());
        CHECK(resumed.report.remarks == whole.report.remarks);
        CHECK(resumed.report.convergence.steps_short_of_tolerance == whole.report.convergence.steps_short_of_tolerance);
        CHECK(resumed.report.seconds.step >= state->seconds.step);
        CHECK(resumed.report.seconds.factorise >= state->seconds.factorise);
        REQUIRE(resumed.report.separated.has_value() == options.report.keep_gaps);
        if (options.report.keep_gaps)
            CHECK(test::same_bits(resumed.report.separated->vertices, whole.report.separated->vertices));
    }
}

/// Far away, and with seams.
PolygonMesh far_in_pieces()
{
    const PolygonMesh whole = make_triangles(500);
    PolygonMesh mesh = test::split(whole, test::random_labels(whole.n_faces(), 2, 3));
    mesh.vertices.array() += 1e6;
    return mesh;
}

}  // namespace

TEST_CASE("a flow that goes on after any step ends with the same bits and the same report")
{
    for (const PolygonMesh& mesh : {make_mixed_polygons(600), make_noisy_sphere(500), far_in_pieces()})
        for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
            CAPTURE(kind.name);
            check_resumed(mesh, kind.options);
        }
    const PolygonMesh mesh = test::rimmed_ball();
    const double edge = mean_edge_length(mesh);
    for (const test::OptionCase& option : test::option_cases()) {
        // The time step for a radius depends on the number of steps.
        if (option.field == "radius")
            continue;
        CAPTURE(option.name());
        AllOptions options = test::options_without_cases(edge);
        option.set(options, mesh, edge);
        check_resumed(mesh, options);
    }
}

TEST_CASE("steps that remove noise go on with what the first one found")
{
    AllOptions options;
    options.denoise = true;
    options.steps = 3;
    check_resumed(make_noisy_sphere(1500, {.amplitude = 0.1, .noise = 0.3}), options);
}

TEST_CASE("sweeps that begin with rescaled surfaces go on with the same bits, with copies of the interface, too")
{
    PolygonMesh mesh = make_noisy_sphere(500);
    mesh.vertices.rowwise() += Point(0.1, 2.0, -0.7);
    for (const Conditions conditions : {Conditions::AdaptedRobin, Conditions::Robin, Conditions::Schwarz}) {
        AllOptions options;
        options.time_step = 0.02;
        options.steps = 4;
        options.cut.subdomains = 3;
        options.flow = FlowEquation::Conformalized;
        options.motion.rescale = Rescale::Volume;
        options.accuracy.approach = Approach::Sweep;
        options.interface.conditions = conditions;
        options.report.reference = true;
        check_resumed(mesh, options);
    }
}

TEST_CASE("a state continues from a state")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    const AllOptions options = test::flow_kinds(mean_edge_length(mesh)).front().options;
    auto state = state_after(1, mesh, options);
    for (int step = 2; step <= options.steps; ++step) {
        AllOptions one_more = options;
        one_more.steps = step;
        PolygonMesh moved = mesh;
        smooth_surface(moved, one_more,
                       [&](const StepState& now) { state = std::make_shared<const FlowState>(now.capture()); },
                       {.stop = {}, .on_progress = {}, .resume = state});
        CHECK(test::same_bits(state->positions(), moved.vertices));
    }
    CHECK(test::same_bits(state->positions(), test::flowed(mesh, options)));
}

TEST_CASE("a state of another flow is refused, and one that was changed")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    const AllOptions options = test::flow_kinds(mean_edge_length(mesh)).front().options;
    const auto state = state_after(2, mesh, options);
    AllOptions other = options;
    other.accuracy.tolerance = 0.1;
    CHECK_THROWS_WITH_AS(run(mesh, other, state), doctest::Contains("belongs to another mesh or to other options"),
                         InputError);
    CHECK_THROWS_AS(run(make_quads(400), options, state), InputError);
    other = options;
    other.steps = 1;
    CHECK_THROWS_WITH(run(mesh, other, state), doctest::Contains("already after step 2"));
    other.resources.threads = 2;
    other.steps = 9;
    other.report.record_schedule = true;
    CHECK_NOTHROW(run(mesh, other, state));
    CHECK_NOTHROW(run(mesh, options, state));

    FlowState broken = *state;
    broken.flow.arrays.pop_back();
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.numbers.front() = -1.0;
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.positions.conservativeResize(599, 3);
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
    broken = *state;
    broken.flow.positions(300, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(run(mesh, options, std::make_shared<const FlowState>(broken)),
                         doctest::Contains("positions that are not finite"), InputError);
    broken = *state;
    broken.displacement.drift.resize(0, 3);
    CHECK_THROWS_AS(run(mesh, options, std::make_shared<const FlowState>(broken)), InputError);
}

TEST_CASE("positions of sub-meshes that are not finite are refused; an estimate that has overflowed goes on as such")
{
    const PolygonMesh mesh = make_triangles(600);
    const double infinity = std::numeric_limits<double>::infinity();
    const auto with_infinite_arrays = [&](const AllOptions& options) {
        FlowState state = *state_after(1, mesh, options);
        REQUIRE(!state.flow.arrays.empty());
        for (Points& array : state.flow.arrays)
            array.setConstant(infinity);
        return std::make_shared<const FlowState>(std::move(state));
    };
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        if (kind.name == "fujiwara by Schwarz")
            CHECK_THROWS_AS(run(mesh, kind.options, with_infinite_arrays(kind.options)), InputError);
        if (kind.name != "fujiwara by sweeps")
            continue;
        const ResultOfRun expected = run(mesh, kind.options);
        const ResultOfRun resumed = run(mesh, kind.options, with_infinite_arrays(kind.options));
        CHECK(resumed.positions == expected.positions);
        CHECK(expected.report.steps.back().estimated_v_max.has_value());
        CHECK_FALSE(resumed.report.steps.back().estimated_v_max.has_value());
    }
}
