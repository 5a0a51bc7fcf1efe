#pragma once

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/ranks/rank_group.h"
#include "engine/ranks/transport.h"
#include "engine/state/flow_state.h"
#include "samples/options/smooth_surface.h"
#include "tests/support/flows.h"
#include "tests/support/messages.h"

/// Flows whose steps ranks share, beside those of one process.
namespace seamflow::test {

/// A flow after its last step.
struct Flowed {
    Points positions = Points(0, 3);
    FlowReport report = {};
    /// After each step.
    std::vector<Points> observed = {};
    std::vector<FlowState> states = {};
};

inline Flowed flowed_with(PolygonMesh mesh, const AllOptions& options, const FlowControl& control)
{
    Flowed result;
    result.report = smooth_surface(
        mesh, options,
        [&](const StepState& state) {
            result.observed.push_back(state.positions);
            result.states.push_back(*state.capture());
        },
        control);
    result.positions = mesh.vertices;
    return result;
}

/// Calls work(ranks) on rank 0 of n, which are threads, and lets the others serve it.
/// @param threads of the machine, for the others. @throws what it throws.
template <class Work>
void on_ranks(int n, int threads, Work&& work)
{
    std::exception_ptr thrown;
    run_on_threads(n, [&](Transport& transport) {
        if (transport.rank() > 0) {
            const int status = serve_flows(transport, threads);
            CHECK(status == 7);
            return;
        }
        RankGroup ranks(transport);
        try {
            work(ranks);
        } catch (...) {
            thrown = std::current_exception();
        }
        ranks.dismiss(7);
    });
    if (thrown)
        std::rethrow_exception(thrown);
}

template <class Work>
void on_ranks(int n, Work&& work)
{
    on_ranks(n, n, work);
}

inline Flowed flowed_on(RankGroup& ranks, const PolygonMesh& mesh, const AllOptions& options, FlowControl control = {})
{
    control.ranks = &ranks;
    ranks.set_threads_of_each(options.resources.threads);
    return flowed_with(mesh, options, control);
}

inline bool same_bits(const StepMemory& a, const StepMemory& b)
{
    return same_bits(a.positions, b.positions) && a.numbers == b.numbers &&
           std::ranges::equal(a.arrays, b.arrays, [](const Points& c, const Points& d) { return same_bits(c, d); });
}

/// Compares with the flow of one process. @param n_ranks those that share it, rank 0 of how many.
inline void check_same(const Flowed& found, const Flowed& expected, int n_ranks)
{
    CHECK(same_bits(found.positions, expected.positions));
    REQUIRE(found.states.size() == expected.states.size());
    for (std::size_t i = 0; i < found.states.size(); ++i) {
        CHECK(same_bits(found.observed[i], expected.observed[i]));
        CHECK(same_bits(found.states[i].flow, expected.states[i].flow));
        CHECK(found.states[i].cut == expected.states[i].cut);
    }
    const FlowReport& report = found.report;
    const FlowReport& other = expected.report;
    REQUIRE(report.cut.n_sub_meshes() == other.cut.n_sub_meshes());
    for (Index s = 0; s < report.cut.n_sub_meshes(); ++s) {
        CHECK(report.cut.sub_meshes[s].faces == other.cut.sub_meshes[s].faces);
        CHECK(report.cut.sub_meshes[s].vertices == other.cut.sub_meshes[s].vertices);
        CHECK(report.cut.sub_meshes[s].colour == other.cut.sub_meshes[s].colour);
        CHECK(report.cut.sub_meshes[s].p == other.cut.sub_meshes[s].p);
    }
    CHECK(report.cut.labels == other.cut.labels);
    CHECK(report.cut.interface_vertices == other.cut.interface_vertices);
    CHECK(report.convergence.steps_short_of_tolerance == other.convergence.steps_short_of_tolerance);
    CHECK(report.convergence.steps_stagnated == other.convergence.steps_stagnated);
    CHECK(report.resources.single_factors == other.resources.single_factors);
    CHECK(test::sentences(report.choices) == test::sentences(other.choices));
    CHECK(test::sentences(report.remarks) == test::sentences(other.remarks));
    CHECK(report.ranks.size() == static_cast<std::size_t>(n_ranks));
    for (std::size_t step = 0; step < report.steps.size(); ++step) {
        CHECK(report.steps[step].iterations == other.steps[step].iterations);
        CHECK(report.steps[step].residual == other.steps[step].residual);
        CHECK(report.steps[step].estimated_v_max == other.steps[step].estimated_v_max);
    }
}

/// Runs a flow in one process, and with each of these numbers of ranks.
inline void check_bits(const std::string& name, const PolygonMesh& mesh, AllOptions options, int subdomains,
                       const std::vector<int>& n_ranks)
{
    CAPTURE(name);
    if (options.cut.labels.empty())
        options.cut.subdomains = subdomains;
    const Flowed expected = flowed_with(mesh, options, {});
    REQUIRE(expected.report.cut.n_sub_meshes() > 1);
    for (const int n : n_ranks) {
        CAPTURE(n);
        on_ranks(n, [&](RankGroup& ranks) { check_same(flowed_on(ranks, mesh, options), expected, n > 1 ? n : 0); });
    }
}

inline AllOptions by_sweeps(Laplacian laplacian, double time_step, int steps = 3)
{
    AllOptions options;
    options.laplacian = laplacian;
    options.time_step = time_step;
    options.steps = steps;
    options.accuracy.approach = Approach::Sweep;
    options.resources.threads = 1;
    return options;
}

inline AllOptions converged(Laplacian laplacian, double time_step, double tolerance = 1e-8)
{
    AllOptions options = by_sweeps(laplacian, time_step);
    options.accuracy.approach = Approach::Converged;
    options.accuracy.tolerance = tolerance;
    return options;
}

}  // namespace seamflow::test
