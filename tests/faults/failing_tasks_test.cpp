// Every task of every graph throws, once.

#include <doctest/doctest.h>

#include "engine/setup/flow_plan.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/tasks/workers.h"
#include "partition/cut/cut_into.h"
#include "solvers/laplacian/mean_curvature.h"
#include "tests/faults/failing_work.h"
#include "tests/faults/small_runs.h"
#include "tests/support/memory_limits.h"

using namespace seamflow;

namespace {

constexpr int n_task_steps = 3;

/// The states of a flow: before it and after each of its steps.
std::vector<Points> states_of(PolygonMesh mesh, const AllOptions& options)
{
    std::vector<Points> states{mesh.vertices};
    smooth_surface(mesh, options, [&](const StepState& state) { states.push_back(state.positions); });
    return states;
}

/// Runs a flow whose task fails in its run of that number.
/// @returns whether there was such a task.
bool fails_well(const AllOptions& options, const std::vector<Points>& states, int task, int run)
{
    PolygonMesh mesh = test::small_mesh();
    int steps_done = 0;
    int caught = 0;
    const test::FailingTask failing(task, run);
    try {
        smooth_surface(mesh, options, [&](const StepState& state) { steps_done = state.step; });
    } catch (const test::TaskFailure& failure) {
        caught = failure.task;
    }
    CHECK(caught == (failing.has_failed() ? task : 0));
    CHECK((caught == 0) == (steps_done == n_task_steps));
    CHECK(test::same_bits(mesh.vertices, states[static_cast<std::size_t>(steps_done)]));
    return failing.has_failed();
}

/// A task fails when it runs for the second time; brought back to where it was before that step, the graph runs again
/// and does what it does without a failure.
/// @returns whether there was such a task.
template <class Flow>
bool runs_again(const std::function<Flow(Progress&)>& make, const Points& expected, int task)
{
    const FlowControl control;
    Progress progress(control);
    const test::FailingTask failing(task, 2);
    Flow flow = make(progress);
    int n_thrown = 0;
    for (int steps_done = 0; steps_done < n_task_steps;) {
        StepMemory memory;
        flow.save(memory);
        try {
            flow.step(memory.positions);
            ++steps_done;
        } catch (const test::TaskFailure& failure) {
            CHECK(failure.task == task);
            ++n_thrown;
            flow.restore(memory);
        }
    }
    CHECK(n_thrown == (failing.has_failed() ? 1 : 0));
    CHECK(test::same_bits(flow.positions(), expected));
    return failing.has_failed();
}

template <class Flow>
Points flowed_by(const std::function<Flow(Progress&)>& make)
{
    const FlowControl control;
    Progress progress(control);
    Flow flow = make(progress);
    for (int step = 1; step <= n_task_steps; ++step)
        flow.step(Points(flow.positions()));
    return flow.positions();
}

template <class Flow>
void every_graph_runs_again(const std::function<Flow(Progress&)>& make)
{
    for (const int threads : {1, 2, 5}) {
        CAPTURE(threads);
        Workers workers(threads);
        int n_tasks = 0;
        workers.execute([&] {
            const Points expected = flowed_by<Flow>(make);
            while (runs_again<Flow>(make, expected, n_tasks + 1))
                ++n_tasks;
        });
        CHECK(n_tasks >= 4);
    }
}

/// What the flows are made of.
struct Parts {
    PolygonMesh mesh = test::small_mesh();
    Topology topology = make_topology(mesh);
    Cut cut = cut_into(mesh, topology, 3);
    AllOptions options = test::small_flows(n_task_steps, 0).front().options;
    std::vector<double> curvature = std::vector<double>(static_cast<std::size_t>(mesh.n_vertices()), 0.0);

    [[nodiscard]] StepSettings settings_for(const WayOfSteps& way) const
    {
        return settings_of(options, way, mesh.vertices);
    }
};

}  // namespace

TEST_CASE("whichever task of a flow throws, that comes out, with any number of threads, and no step in part")
{
    for (const int threads : {1, 2, 5})
        for (const test::FlowKind& kind : test::small_flows(n_task_steps, threads)) {
            CAPTURE(kind.name);
            CAPTURE(threads);
            const std::vector<Points> states = states_of(test::small_mesh(), kind.options);
            // Of two sweeps in turn each task runs in every other step.
            for (const int run : {1, 2}) {
                int n_tasks = 0;
                while (fails_well(kind.options, states, n_tasks + 1, run))
                    ++n_tasks;
                CHECK((n_tasks >= 3 || !kind.factorises()));
            }
            CHECK(test::same_bits(test::flowed(test::small_mesh(), kind.options), states.back()));
        }
}

TEST_CASE("a graph one of whose tasks has thrown runs again, and gives the same bits")
{
    Parts parts;
    SUBCASE("sweeps")
    {
        for (const InterfaceConditions& conditions :
             {InterfaceConditions(PredictedTransmission()), InterfaceConditions(AdaptedConditions())})
            every_graph_runs_again<SweepStepper>([&](Progress& progress) {
                const SweepSteps sweeps{.conditions = conditions, .alternates = true, .corrects = true};
                return SweepStepper(parts.mesh, parts.topology, parts.cut, parts.settings_for(sweeps), sweeps,
                                    parts.curvature, progress);
            });
    }
    SUBCASE("sweeps with a filter of several solutions")
    {
        parts.options.filter = Filter::LowPass;
        every_graph_runs_again<SweepStepper>([&](Progress& progress) {
            const SweepSteps sweeps{.conditions = PredictedTransmission(), .alternates = true, .corrects = true};
            return SweepStepper(parts.mesh, parts.topology, parts.cut, parts.settings_for(sweeps), sweeps,
                                parts.curvature, progress);
        });
    }
    const ConvergedSteps converged{{.tolerance = 1e-3, .iterations = 1000}};
    SUBCASE("converged")
    {
        every_graph_runs_again<SchurStepper>([&](Progress& progress) {
            return SchurStepper(parts.mesh, parts.topology, parts.cut, parts.settings_for(converged), converged.stop,
                                progress);
        });
    }
    SUBCASE("converged in little memory")
    {
        parts.options.accuracy.tolerance = converged.stop.tolerance;
        parts.options.resources.memory_limit = test::least_memory_limit(parts.mesh, parts.options).value();
        every_graph_runs_again<SchurStepper>([&](Progress& progress) {
            return SchurStepper(parts.mesh, parts.topology, parts.cut, parts.settings_for(converged), converged.stop,
                                progress);
        });
    }
}
