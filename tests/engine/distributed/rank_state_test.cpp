// Flows on ranks that stop after a step, and go on on other ranks.

#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "tests/engine/distributed/parts.h"
#include "tests/engine/distributed/rank_flows.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::by_sweeps;
using test::converged;
using test::Example;

namespace {

Index begin_of_range(Eigen::Index n_vertices, int rank, int n)
{
    return static_cast<Index>(n_vertices * rank / n);
}

/// What rank of n keeps of the state of a mesh.
RankFlowState share_of(const RankFlowState& whole, int rank, int n)
{
    const Eigen::Index n_vertices = whole.vertices.rows();
    const Index begin = begin_of_range(n_vertices, rank, n);
    const Index size = begin_of_range(n_vertices, rank + 1, n) - begin;
    RankFlowState share{
        .step = whole.step, .vertices = whole.vertices.middleRows(begin, size), .numbers = whole.numbers};
    for (const Points& array : whole.arrays)
        share.arrays.emplace_back(array.middleRows(begin, size));
    return share;
}

/// Puts that of rank of n back.
void put_share(const RankFlowState& share, int rank, int n, RankFlowState& whole)
{
    const Index begin = begin_of_range(whole.vertices.rows(), rank, n);
    whole.step = share.step;
    whole.vertices.middleRows(begin, share.vertices.rows()) = share.vertices;
    whole.arrays.resize(share.arrays.size(), Points::Zero(whole.vertices.rows(), 3));
    for (std::size_t i = 0; i < share.arrays.size(); ++i)
        whole.arrays[i].middleRows(begin, share.arrays[i].rows()) = share.arrays[i];
    whole.numbers = share.numbers;
}

/// A flow on ranks, and what it has reported.
struct Run {
    Points positions;
    RankReport report;
    RankFlowState last;
};

/// @param from null: from the beginning.
Run run_on_ranks(const Example& example, const CutReport& cut, int n, const RankFlowState* from)
{
    Run run{example.mesh.vertices, {}, {.step = 0, .vertices = example.mesh.vertices}};
    std::mutex mutex;
    run_on_threads(n, [&](Transport& transport) {
        const int rank = transport.rank();
        MeshPart part = test::part_of(example.mesh, cut.labels, rank, n, example.fixed);
        RankFlowState share;
        if (from != nullptr)
            share = share_of(*from, rank, n);
        const RankFlowState at_first = share_of({.step = 0, .vertices = example.mesh.vertices}, rank, n);
        RankFlowState kept;
        const RankReport report = distributed_mean_curvature_flow(
            transport, part, example.options,
            [&](const RankStepState& state) { kept = state.capture(at_first.vertices); },
            from != nullptr ? &share : nullptr);
        const std::scoped_lock lock(mutex);
        for (std::size_t v = 0; v < part.vertex_numbers.size(); ++v)
            run.positions.row(static_cast<Index>(part.vertex_numbers[v])) =
                part.mesh.vertices.row(static_cast<Index>(v));
        put_share(kept, rank, n, run.last);
        run.report = report;
    });
    return run;
}

/// Two steps on two ranks, one on others, and the rest on others again.
void check_going_on(Example example, int subdomains)
{
    CAPTURE(example.name);
    PolygonMesh mesh = example.mesh;
    FlowOptions options = example.options;
    options.cut.subdomains = subdomains;
    options.motion.fixed_vertices = example.fixed;
    const FlowReport expected = mean_curvature_flow(mesh, options);
    const int steps = example.options.steps;
    example.options.steps = 2;
    const Run begun = run_on_ranks(example, expected.cut, 2, nullptr);
    for (const int n : {1, 3, 5}) {
        CAPTURE(n);
        example.options.steps = 3;
        const Run going_on = run_on_ranks(example, expected.cut, n, &begun.last);
        CHECK(going_on.report.flow.steps.size() == 1);
        CHECK(going_on.last.step == 3);
        example.options.steps = steps;
        const Run ended = run_on_ranks(example, expected.cut, 6 - n, &going_on.last);
        CHECK(test::same_bits(ended.positions, mesh.vertices));
        CHECK(ended.report.flow.steps.back().iterations == expected.steps.back().iterations);
        CHECK(ended.report.flow.steps.back().residual == expected.steps.back().residual);
        CHECK(ended.report.flow.steps.back().estimated_v_max.value() ==
              test::relative(expected.steps.back().estimated_v_max.value(), 1e-12));
        CHECK(ended.report.flow.convergence.steps_short_of_tolerance == expected.convergence.steps_short_of_tolerance);
    }
}

}  // namespace

TEST_CASE("sweeps of ranks resume from a state on any number of ranks with the same bits")
{
    for (const Laplacian laplacian : test::all_laplacians)
        check_going_on({std::string(name_of(laplacian)), make_mixed_polygons(700), by_sweeps(laplacian, 2e-3, 5)}, 9);
    FlowOptions options = by_sweeps(Laplacian::VirtualRefinement, 2e-3, 5);
    options.filter = Filter::LowPass;
    options.flow = FlowEquation::Conformalized;
    options.motion.attachment = 0.3;
    check_going_on({"filtered", make_noisy_sphere(800), options}, 9);
}

TEST_CASE("converged steps of ranks resume from a state on any number of ranks with the same bits")
{
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement}) {
        FlowOptions options = converged(laplacian, 1e-3, 1e-6);
        options.steps = 5;
        check_going_on({std::string(name_of(laplacian)), make_mixed_polygons(700), options}, 9);
        options.motion.boundary = Boundary::Free;
        check_going_on({"free boundary", make_mixed_polygons(700), options}, 9);
        options.filter = Filter::LowPass;
        check_going_on({"low-pass", make_mixed_polygons(700), options}, 9);
        options.filter = Filter::Diffusion;
        options.flow = FlowEquation::Conformalized;
        check_going_on({"conformalized", make_noisy_sphere(800), options}, 9);
    }
    FlowOptions options = converged(Laplacian::Fujiwara, 2e-2, 1e-12);
    options.steps = 5;
    options.accuracy.converge_iterations = 2;
    check_going_on({"short of its tolerance", make_mixed_polygons(700), options}, 9);
    // Ranks without a vertex of Γ; and no vertex of Γ at all.
    options.accuracy.converge_iterations = 100;
    check_going_on({"apart", test::side_by_side({make_triangles(300), make_hexagons(300), make_quads(900)}), options},
                   4);
    check_going_on({"one sub-mesh", make_triangles(300), options}, 1);
}

TEST_CASE("a state of other steps, or of another mesh, is refused by all ranks alike")
{
    Example example{"refused", make_triangles(500), converged(Laplacian::Fujiwara, 1e-2)};
    FlowOptions options = example.options;
    options.cut.subdomains = 6;
    PolygonMesh mesh = example.mesh;
    const CutReport cut = mean_curvature_flow(mesh, options).cut;
    RankFlowState state = run_on_ranks(example, cut, 3, nullptr).last;
    const auto check_refused = [&](const RankFlowState& from, const std::string& expected) {
        CAPTURE(expected);
        run_on_threads(3, [&](Transport& transport) {
            MeshPart part = test::part_of(example.mesh, cut.labels, transport.rank(), 3);
            const RankFlowState share = share_of(from, transport.rank(), 3);
            CHECK_THROWS_WITH_AS(distributed_mean_curvature_flow(transport, part, example.options, {}, &share),
                                 expected.c_str(), InputError);
        });
    };
    example.options.steps = 5;
    RankFlowState broken = state;
    broken.arrays.front()(broken.arrays.front().rows() - 1, 1) = std::nan("");
    broken.arrays.front().row(0).setConstant(std::nan(""));
    broken.vertices(broken.vertices.rows() - 1, 1) = std::nan("");
    check_refused(broken, "the state to resume from has vertices that are not finite");
    RankFlowState short_of_vertices = share_of(state, 0, 2);
    check_refused(short_of_vertices, "the state to resume from has fewer vertices than the mesh");
    example.options = by_sweeps(Laplacian::Fujiwara, 1e-2, 5);
    check_refused(state, "the state to resume from belongs to steps of another kind");
    state.numbers.resize(1);
    example.options = converged(Laplacian::Fujiwara, 1e-2);
    check_refused(state, "the state to resume from belongs to steps of another kind");
}
