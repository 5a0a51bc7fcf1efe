#include <memory>
#include <stop_token>
#include <vector>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/options/flow_control.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/flows.h"

using namespace seamflow;
using test::same_bits;

TEST_CASE("a flow taken step by step has the bits and the report of one call")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        CAPTURE(kind.name);
        std::vector<Points> after;
        PolygonMesh at_once = mesh;
        const FlowReport expected = mean_curvature_flow(
            at_once, kind.options, [&](const StepState& state) { after.push_back(state.positions); });
        PolygonMesh moved = mesh;
        Flow flow(moved, kind.options);
        CHECK(same_bits(moved.vertices, mesh.vertices));
        for (int step = 1; step <= kind.options.steps; ++step) {
            flow.step();
            CHECK(flow.n_steps() == step);
            CHECK(same_bits(moved.vertices, after[usize(step - 1)]));
            // To look at the report changes nothing.
            CHECK(flow.report().steps.size() == usize(step));
        }
        const FlowReport report = flow.report();
        CHECK(report.remarks == expected.remarks);
        CHECK(report.choices == expected.choices);
        CHECK(report.cut.labels == expected.cut.labels);
        CHECK(report.cut.sub_meshes.size() == expected.cut.sub_meshes.size());
        CHECK(report.separated.has_value() == expected.separated.has_value());
        for (std::size_t i = 0; i < expected.steps.size(); ++i)
            CHECK(report.steps[i].estimated_v_max == expected.steps[i].estimated_v_max);
    }
}

TEST_CASE("a flow goes on beyond the steps that were expected, also from a state")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    FlowOptions options{.time_step = 1e-3, .steps = 5, .cut = {.subdomains = 7}};
    options.flow = FlowEquation::Linear;
    options.accuracy.tolerance = 1e-6;
    const Points expected = test::flowed(mesh, options);
    options.steps = 2;
    PolygonMesh moved = mesh;
    FlowControl resumed;
    int n_seen = 0;
    Flow flow(moved, options, [&](const StepState& state) {
        ++n_seen;
        if (state.step == 2)
            resumed.resume = state.capture();
    });
    flow.step(0);
    CHECK(same_bits(moved.vertices, mesh.vertices));
    flow.step(5);
    CHECK(n_seen == 5);
    CHECK(same_bits(moved.vertices, expected));
    PolygonMesh other = mesh;
    Flow rest(other, options, {}, resumed);
    CHECK(rest.n_steps() == 2);
    rest.step(3);
    CHECK(same_bits(other.vertices, expected));
    CHECK(rest.report().steps.size() == 5);
}

TEST_CASE("a call that is stopped ends after its step, and the flow goes on as if nothing had happened")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    for (const test::FlowKind& kind : test::flow_kinds(mean_edge_length(mesh))) {
        CAPTURE(kind.name);
        FlowOptions options = kind.options;
        options.steps = 3;
        PolygonMesh at_once = mesh;
        const FlowReport expected = mean_curvature_flow(at_once, options);
        PolygonMesh moved = mesh;
        std::stop_source stop;
        Flow flow(moved, options, [&](const StepState& state) {
            if (state.step == 2)
                stop.request_stop();
        });
        CHECK(flow.step(3, stop.get_token()) == 2);
        CHECK(flow.n_steps() == 2);
        CHECK(flow.step(3, stop.get_token()) == 0);
        // Each call has a token of its own.
        CHECK(flow.step(1, std::stop_source().get_token()) == 1);
        CHECK(same_bits(moved.vertices, at_once.vertices));
        CHECK(flow.report().remarks == expected.remarks);
    }
}

TEST_CASE("a linear flow with a filter resumes with the same bits where single precision goes no further")
{
    const PolygonMesh mesh = make_noisy_sphere(3000);
    FlowOptions options{.time_step = 1.0, .steps = 4, .cut = {.subdomains = 8}};
    options.flow = FlowEquation::Linear;
    options.filter = Filter::LowPass;
    options.order = 3;
    options.accuracy.tolerance = 5e-18;
    PolygonMesh whole = mesh;
    FlowControl resumed;
    Flow flow(whole, options, [&](const StepState& state) {
        if (state.step == 2)
            resumed.resume = state.capture();
    });
    flow.step(4);
    PolygonMesh rest = mesh;
    mean_curvature_flow(rest, options, {}, resumed);
    CHECK(same_bits(rest.vertices, whole.vertices));
}

TEST_CASE("after a failure a flow has its last complete step, and takes no further one")
{
    const PolygonMesh mesh = make_mixed_polygons(300);
    const FlowOptions options{.time_step = 1e-3, .steps = 3};
    PolygonMesh moved = mesh;
    Flow flow(moved, options, [](const StepState& state) {
        if (state.step == 2)
            throw OutputError("the disk is full");
    });
    flow.step();
    CHECK_THROWS_AS(flow.step(), OutputError);
    const Points kept = moved.vertices;
    CHECK_THROWS_WITH_AS(flow.step(), doctest::Contains("begin a new flow"), ComputationError);
    CHECK(same_bits(moved.vertices, kept));
    PolygonMesh faulty = mesh;
    CHECK_THROWS_AS(Flow(faulty, FlowOptions{.time_step = -1.0}), OptionError);
}
