// Flows whose steps ranks share, as threads, with a failure at one of them: rank 0 gets it, nothing moves, and all end.

#include <string>

#include "engine/mean_curvature_flow.h"
#include "tests/engine/ranks/rank_flows.h"
#include "tests/faults/every_allocation.h"
#include "tests/faults/failing_work.h"
#include "tests/faults/small_runs.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

/// A small mesh whose sub-meshes two ranks share.
struct SharedFlow {
    FlowOptions options;
    PolygonMesh before = test::small_mesh();
    PolygonMesh mesh = before;
    bool captures_states = false;

    explicit SharedFlow(Approach approach)
    {
        options.time_step = 1e-3;
        options.steps = 3;
        options.accuracy.approach = approach;
        options.cut.subdomains = 3;
        options.report.measures = false;
        options.resources.threads = 1;
    }

    void run()
    {
        mesh = before;
        test::on_ranks(2, [&](RankGroup& ranks) {
            ranks.set_threads_of_each(1);
            FlowControl control;
            control.ranks = &ranks;
            StepObserver capture;
            if (captures_states)
                capture = [](const StepState& state) { state.capture(); };
            mean_curvature_flow(mesh, options, capture, control);
        });
    }

    /// @returns what rank 0 throws; empty: nothing.
    std::string failure()
    {
        return test::message_of<ComputationError>([&] { run(); });
    }

    [[nodiscard]] std::string result() const
    {
        return {reinterpret_cast<const char*>(mesh.vertices.data()),
                static_cast<std::size_t>(mesh.vertices.size()) * sizeof(double)};
    }
};

}  // namespace

TEST_CASE("every allocation of a flow that ranks share")
{
    for (const Approach approach : {Approach::Sweep, Approach::Converged}) {
        SharedFlow flow(approach);
        // One step has all kinds of them.
        flow.options.steps = 1;
        flow.captures_states = true;
        test::fail_every_allocation({.run = [&] { flow.run(); },
                                     .result = [&] { return flow.result(); },
                                     .check_failed = [] {},
                                     .most_lost = 150,
                                     .ways = {test::Failing::Once}});
    }
}

TEST_CASE("every task of ranks, in its first run and in its second")
{
    for (const Approach approach : {Approach::Sweep, Approach::Converged}) {
        SharedFlow flow(approach);
        for (const int run : {1, 2}) {
            int task = 1;
            for (bool has_failed = true; has_failed; ++task) {
                CAPTURE(task);
                const test::FailingTask failing(task, run);
                const std::string thrown = flow.failure();
                has_failed = failing.has_failed();
                CHECK(thrown.empty() != has_failed);
            }
            CHECK(task > 6);
        }
    }
}

TEST_CASE("factorisations of ranks, each with all after it")
{
    SharedFlow flow(Approach::Sweep);
    for (int n = 1; n <= 6; ++n) {
        CAPTURE(n);
        const test::FailingFactorisation failing(n, test::FailingFactorisation::After::Fails);
        const std::string thrown = flow.failure();
        CHECK(thrown.find(n <= 3 ? "step 1, " : "step 2, ") == 0);
        CHECK(thrown.find("sub-mesh ") != std::string::npos);
    }
}
