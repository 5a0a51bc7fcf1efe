// Flows that ranks share, as threads, with a failure at one of them: all end, with the same message, and nothing moves.

#include <algorithm>
#include <string>
#include <vector>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/mean_curvature_flow.h"
#include "tests/engine/distributed/parts.h"
#include "tests/faults/every_allocation.h"
#include "tests/faults/failing_work.h"
#include "tests/faults/small_runs.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

/// A small mesh that two ranks share.
struct SharedFlow {
    FlowOptions options;
    std::vector<MeshPart> before;
    std::vector<MeshPart> parts;
    /// Of all vertices, which make up the range of the first rank.
    Points range;
    bool captures_states = false;

    explicit SharedFlow(Approach approach)
    {
        options.time_step = 1e-3;
        options.steps = 3;
        options.accuracy.approach = approach;
        // Measuring takes many allocations, alike in both: once is enough.
        options.report.measures = approach == Approach::Converged;
        options.resources.threads = 1;
        const PolygonMesh mesh = test::small_mesh();
        range = mesh.vertices;
        PolygonMesh cut = mesh;
        options.cut.subdomains = 3;
        const FlowReport report = mean_curvature_flow(cut, options);
        options.cut.subdomains = 0;
        for (int rank = 0; rank < 2; ++rank)
            before.push_back(test::part_of(mesh, report.cut.labels, rank, 2));
        parts = before;
    }

    void run()
    {
        for (std::size_t r = 0; r < parts.size(); ++r)
            parts[r].mesh.vertices = before[r].mesh.vertices;
        run_on_threads(2, [&](Transport& transport) {
            RankObserver capture;
            if (captures_states)
                capture = [&](const RankStepState& state) {
                    state.capture(range.topRows(transport.rank() == 0 ? range.rows() : 0));
                };
            distributed_mean_curvature_flow(transport, parts[transport.rank()], options, capture);
        });
    }

    /// @returns what both ranks throw, which is the same; empty: nothing.
    std::string failure()
    {
        std::vector<std::string> thrown(2);
        for (std::size_t r = 0; r < parts.size(); ++r)
            parts[r].mesh.vertices = before[r].mesh.vertices;
        run_on_threads(2, [&](Transport& transport) {
            try {
                distributed_mean_curvature_flow(transport, parts[transport.rank()], options);
            } catch (const ComputationError& error) {
                thrown[transport.rank()] = error.what();
            }
        });
        CHECK(thrown[0] == thrown[1]);
        return thrown[0];
    }

    void check_unmoved() const
    {
        for (std::size_t r = 0; r < parts.size(); ++r)
            CHECK(test::same_bits(parts[r].mesh.vertices, before[r].mesh.vertices));
    }

    [[nodiscard]] std::string result() const
    {
        std::string bytes;
        for (const MeshPart& part : parts)
            bytes.append(reinterpret_cast<const char*>(part.mesh.vertices.data()),
                         static_cast<std::size_t>(part.mesh.vertices.size()) * sizeof(double));
        return bytes;
    }
};

}  // namespace

TEST_CASE("every allocation of a flow that ranks share")
{
    SharedFlow flow(Approach::Sweep);
    test::fail_every_allocation({.run = [&] { flow.run(); },
                                 .result = [&] { return flow.result(); },
                                 .check_failed = [&] { flow.check_unmoved(); },
                                 .most_lost = 150,
                                 .ways = {test::Failing::Once}});
}

TEST_CASE("allocations of converged steps that ranks share")
{
    SharedFlow flow(Approach::Converged);
    // One step has all kinds of them.
    flow.options.steps = 1;
    flow.captures_states = true;
    test::fail_every_allocation({.run = [&] { flow.run(); },
                                 .result = [&] { return flow.result(); },
                                 .check_failed = [&] { flow.check_unmoved(); },
                                 .most_lost = 100,
                                 .ways = {test::Failing::Once}});
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
                if (has_failed)
                    flow.check_unmoved();
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
        CHECK(thrown.find(n <= 3 ? "step 1, sub-mesh " : "step 2, sub-mesh ") != std::string::npos);
        flow.check_unmoved();
    }
}
