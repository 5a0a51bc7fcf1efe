// Flows of every kind with every single allocation failing: the mesh then has the last complete step.

#include <memory>
#include <string>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_state.h"
#include "tests/faults/every_allocation.h"
#include "tests/faults/small_runs.h"

using namespace seamflow;

namespace {

std::string bytes_of(const Points& points)
{
    return {reinterpret_cast<const char*>(points.data()), static_cast<std::size_t>(points.size()) * sizeof(double)};
}

/// @param resume where to go on; nullptr: the flow begins.
void fail_every_allocation_of(const AllOptions& options, const std::vector<test::Failing>& ways,
                              const std::shared_ptr<const FlowState>& resume = nullptr)
{
    const PolygonMesh input = test::small_mesh();
    PolygonMesh mesh = input;
    std::vector<Points> states{input.vertices};
    smooth_surface(mesh, options, [&](const StepState& state) { states.push_back(state.positions); });
    int steps_done = 0;
    const auto run = [&] {
        mesh.vertices = input.vertices;
        steps_done = 0;
        const FlowControl control{.stop = {}, .on_progress = {}, .resume = resume};
        smooth_surface(
            mesh, options, [&](const StepState& state) { steps_done = state.step; }, control);
    };
    const auto check = [&] {
        // That of the state to resume from counts as soon as it is taken over.
        const bool has_taken_over = resume != nullptr && steps_done == 0 && mesh.vertices != input.vertices;
        const int step = has_taken_over ? resume->n_steps() : steps_done;
        CHECK(test::same_bits(mesh.vertices, states[static_cast<std::size_t>(step)]));
    };
    test::fail_every_allocation({.run = run,
                                 .result = [&] { return bytes_of(mesh.vertices); },
                                 .check_failed = check,
                                 .most_lost = options.scheme == Scheme::ExplicitEuler ? 0 : 100,
                                 .ways = ways});
}

AllOptions options_of(const std::string& name, int threads = 1)
{
    for (const test::FlowKind& kind : test::small_flows(2, threads))
        if (kind.name == name)
            return kind.options;
    FAIL("there is no flow called " << name);
    return {};
}

}  // namespace

// Threads that wait for each other take long on a busy machine: flows of the other kinds have one.
TEST_CASE("sweeps, with one allocation failing, on two threads, and with all from one on")
{
    fail_every_allocation_of(options_of("fujiwara by sweeps", 2), {test::Failing::Once});
    fail_every_allocation_of(options_of("fujiwara by sweeps"), {test::Failing::FromThenOn});
}

TEST_CASE("converged steps, on two threads")
{
    fail_every_allocation_of(options_of("fujiwara converged", 2), {test::Failing::Once});
    fail_every_allocation_of(options_of("converged in little memory", 2), {test::Failing::Once});
}

TEST_CASE("overlapping sub-meshes")
{
    fail_every_allocation_of(options_of("fujiwara by Schwarz"), {test::Failing::Once});
}

TEST_CASE("sweeps with systems that are not symmetric")
{
    fail_every_allocation_of(options_of("ptackova-velho by sweeps"), {test::Failing::Once});
}

TEST_CASE("converged steps with systems that are not symmetric")
{
    fail_every_allocation_of(options_of("ptackova-velho converged"), {test::Failing::Once});
}

TEST_CASE("sweeps and undecomposed steps by factorisations of other libraries, whichever of their phases lacks memory")
{
    for (const Factorisation factorisation : {Factorisation::Cholmod, Factorisation::Umfpack}) {
        CAPTURE(static_cast<int>(factorisation));
        if (!is_available(factorisation))
            continue;
        AllOptions options = options_of("fujiwara by sweeps");
        options.resources.factorisation = factorisation;
        fail_every_allocation_of(options, {test::Failing::Once});
        options.accuracy.approach = Approach::Undecomposed;
        options.cut.subdomains = 0;
        fail_every_allocation_of(options, {test::Failing::Once, test::Failing::FromThenOn});
    }
}

TEST_CASE("the classical conditions, with gaps between the sub-meshes")
{
    fail_every_allocation_of(options_of("robin with gaps"), {test::Failing::Once});
}

TEST_CASE("explicit steps")
{
    fail_every_allocation_of(options_of("explicit"), {test::Failing::Once});
}

TEST_CASE("a flow that continues from a state")
{
    const AllOptions options = options_of("alexa-wardetzky converged");
    std::shared_ptr<const FlowState> first;
    PolygonMesh mesh = test::small_mesh();
    smooth_surface(mesh, options, [&](const StepState& state) {
        if (state.step == 1)
            first = state.capture();
    });
    fail_every_allocation_of(options, {test::Failing::Once}, first);
}
