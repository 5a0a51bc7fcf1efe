#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/mean_curvature_flow.h"
#include "tests/engine/distributed/parts.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

/// Flows on ranks that are threads, beside those of one machine.
namespace seamflow::test {

/// A mesh and the cut of a flow on one machine, whose result it has.
struct Example {
    std::string name;
    PolygonMesh mesh;
    FlowOptions options;
    std::vector<Index> fixed = {};
    std::vector<double> weights = {};
    std::vector<double> strengths = {};
    /// Of a cut of its own.
    std::vector<Index> labels = {};
};

struct Result {
    Points positions;
    std::vector<RankReport> reports;
};

/// The mesh after a flow on n ranks with these labels. Vertices that several ranks have are the same at all of them.
inline Result flowed_on_ranks(const Example& example, const std::vector<Index>& labels, int n)
{
    Result result{example.mesh.vertices, std::vector<RankReport>(n)};
    std::vector<std::uint8_t> is_written(example.mesh.n_vertices(), 0);
    std::mutex mutex;
    run_on_threads(n, [&](Transport& transport) {
        MeshPart part = part_of(example.mesh, labels, transport.rank(), n, example.fixed);
        for (const std::int64_t number : part.vertex_numbers) {
            if (!example.weights.empty())
                part.attachment_weights.push_back(example.weights[static_cast<std::size_t>(number)]);
            if (!example.strengths.empty())
                part.strengths.push_back(example.strengths[static_cast<std::size_t>(number)]);
        }
        result.reports[transport.rank()] = distributed_mean_curvature_flow(transport, part, example.options);
        const std::scoped_lock lock(mutex);
        for (std::size_t v = 0; v < part.vertex_numbers.size(); ++v) {
            const auto number = static_cast<Index>(part.vertex_numbers[v]);
            const Point position = part.mesh.vertices.row(static_cast<Index>(v));
            if (is_written[number] != 0)
                CHECK(Point(result.positions.row(number)) == position);
            result.positions.row(number) = position;
            is_written[number] = 1;
        }
    });
    return result;
}

/// Sorted: the remarks but for those on the cut, which ranks are given.
inline std::vector<std::string> of_flow(std::vector<std::string> remarks)
{
    std::erase_if(remarks, [](const std::string& remark) {
        return remark.starts_with("The sub-meshes are narrow") || remark.starts_with("The mesh was cut into ") ||
               remark.starts_with("The labels name ") || remark.find(" to change parts so that ") != std::string::npos;
    });
    std::ranges::sort(remarks);
    return remarks;
}

/// Compares the report of a rank with that of one machine.
inline void check_report(const FlowReport& rank, const FlowReport& report)
{
    REQUIRE(rank.cut.n_sub_meshes() == report.cut.n_sub_meshes());
    for (Index s = 0; s < report.cut.n_sub_meshes(); ++s) {
        CHECK(rank.cut.sub_meshes[s].faces == report.cut.sub_meshes[s].faces);
        CHECK(rank.cut.sub_meshes[s].vertices == report.cut.sub_meshes[s].vertices);
        CHECK(rank.cut.sub_meshes[s].colour == report.cut.sub_meshes[s].colour);
        CHECK(rank.cut.sub_meshes[s].p == report.cut.sub_meshes[s].p);
    }
    CHECK(rank.cut.interface_vertices == report.cut.interface_vertices);
    CHECK(rank.mesh.non_manifold_vertices == report.mesh.non_manifold_vertices);
    CHECK(rank.mesh.junction_vertices == report.mesh.junction_vertices);
    CHECK(rank.mesh.faces == report.mesh.faces);
    CHECK(rank.time_step == report.time_step);
    CHECK(rank.convergence.approach == report.convergence.approach);
    CHECK(rank.convergence.tolerance == report.convergence.tolerance);
    CHECK(rank.resources.single_factors == report.resources.single_factors);
    CHECK(of_flow(rank.remarks) == of_flow(report.remarks));
    REQUIRE(rank.steps.size() == report.steps.size());
    for (std::size_t step = 0; step < rank.steps.size(); ++step) {
        const StepReport& own = rank.steps[step];
        const StepReport& expected = report.steps[step];
        CHECK(own.iterations == expected.iterations);
        CHECK(own.residual == expected.residual);
        CHECK(own.estimated_v_max.value_or(-1.0) == relative(expected.estimated_v_max.value_or(-1.0), 1e-12));
    }
}

/// Compares with the flow on one machine, for each of these numbers of ranks.
inline void check_bits(const Example& example, int subdomains, const std::vector<int>& n_ranks)
{
    CAPTURE(example.name);
    PolygonMesh mesh = example.mesh;
    FlowOptions options = example.options;
    options.cut.subdomains = example.labels.empty() ? subdomains : 0;
    options.cut.labels = example.labels;
    options.motion.fixed_vertices = example.fixed;
    options.motion.attachment_weights = example.weights;
    options.motion.strength = example.strengths;
    const FlowReport report = mean_curvature_flow(mesh, options);
    REQUIRE(report.cut.n_sub_meshes() > 1);
    for (const int n : n_ranks) {
        CAPTURE(n);
        const Result result = flowed_on_ranks(example, report.cut.labels, n);
        CHECK(same_bits(result.positions, mesh.vertices));
        for (const RankReport& rank : result.reports) {
            check_report(rank.flow, report);
            for (std::size_t step = 0; step < report.steps.size(); ++step)
                CHECK(rank.flow.steps[step].estimated_v_max == result.reports.front().flow.steps[step].estimated_v_max);
        }
    }
}

inline FlowOptions by_sweeps(Laplacian laplacian, double time_step, int steps = 3)
{
    FlowOptions options;
    options.laplacian = laplacian;
    options.time_step = time_step;
    // Ranks have to be told; meshes here are some ten edges across.
    if (laplacian == Laplacian::Uniform)
        options.uniform_edge = 0.04;
    options.steps = steps;
    options.accuracy.approach = Approach::Sweep;
    options.resources.threads = 1;
    return options;
}

inline FlowOptions converged(Laplacian laplacian, double time_step, double tolerance = 1e-8)
{
    FlowOptions options = by_sweeps(laplacian, time_step);
    options.accuracy.approach = Approach::Converged;
    options.accuracy.tolerance = tolerance;
    return options;
}

inline const std::vector<int> some_numbers_of_ranks{1, 2, 3, 5, 8};

}  // namespace seamflow::test
