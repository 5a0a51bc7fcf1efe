#include "samples/benchmark/simulated_ranks.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "engine/mean_curvature_flow.h"
#include "engine/ranks/rank_group.h"
#include "engine/ranks/thread_transport.h"

namespace seamflow {

namespace {

struct RunOnRanks {
    PolygonMesh mesh;
    FlowReport report;
};

RunOnRanks run_on_ranks(const PolygonMesh& mesh, FlowOptions flow, int n)
{
    RunOnRanks run{mesh, {}};
    flow.resources.threads = 1;
    run_on_threads(n, [&](Transport& transport) {
        if (transport.rank() > 0) {
            serve_flows(transport, n);
            return;
        }
        RankGroup ranks(transport);
        FlowControl control;
        control.ranks = &ranks;
        run.report = mean_curvature_flow(run.mesh, flow, {}, control);
    });
    return run;
}

/// @param steps of the flow, all of which send as much.
RankCounts counts_of(const RunOnRanks& run, int n_ranks, int steps, const Points& expected)
{
    RankCounts counts;
    counts.ranks = n_ranks;
    counts.sub_meshes = run.report.cut.n_sub_meshes();
    counts.most_vertices = n_ranks == 1 ? run.mesh.n_vertices() : 0;
    counts.mean_vertices = static_cast<double>(run.mesh.n_vertices()) / n_ranks;
    for (const RankRecord& rank : run.report.ranks) {
        counts.most_vertices = std::max(counts.most_vertices, static_cast<Index>(rank.vertices));
        counts.messages = std::max(counts.messages, rank.messages / static_cast<std::uint64_t>(steps));
        counts.bytes = std::max(counts.bytes, rank.bytes / static_cast<std::uint64_t>(steps));
    }
    counts.iterations = run.report.steps.back().iterations;
    counts.same_bits = (run.mesh.vertices.array() == expected.array()).all();
    return counts;
}

/// A network between machines.
struct Network {
    const char* name;
    /// From machine to machine: seconds; bytes per second.
    double latency;
    double bandwidth;
};

constexpr Network networks[] = {{"InfiniBand (2 us, 12 GB/s)", 2e-6, 12e9}, {"10 Gbit/s Ethernet", 25e-6, 1.2e9}};
constexpr int machines = 64;
constexpr int cores = 64;

/// Seconds that a machine of m vertices needs to communicate a step.
double network_seconds(const RankCounts& counts, const Network& network, double m)
{
    const double growth = std::sqrt(m / counts.mean_vertices);
    const double latencies = static_cast<double>(counts.messages) * network.latency;
    return latencies * (counts.iterations ? 1.0 : growth) +
           static_cast<double>(counts.bytes) / network.bandwidth * growth;
}

/// The number of vertices with which computing takes as long as communicating: with fewer the network is the limit.
double vertices_where_even(const RankCounts& counts, const Network& network, double seconds_per_vertex)
{
    // Computing grows faster than communicating.
    double low = 1.0;
    double high = 1e15;
    while (high / low > 1.001) {
        const double m = std::sqrt(low * high);
        (m * seconds_per_vertex < network_seconds(counts, network, m) ? low : high) = m;
    }
    return high;
}

}  // namespace

SimulatedRanks simulate_ranks(const PolygonMesh& mesh, const FlowOptions& flow, const std::vector<int>& ranks)
{
    SimulatedRanks simulated;
    const RunOnRanks alone = run_on_ranks(mesh, flow, 1);
    std::vector<double> seconds;
    for (const StepReport& step : alone.report.steps)
        seconds.push_back(step.seconds);
    std::ranges::sort(seconds);
    simulated.seconds_per_vertex = seconds[seconds.size() / 2] / mesh.n_vertices();
    for (const int n : ranks)
        simulated.counts.push_back(
            counts_of(n == 1 ? alone : run_on_ranks(mesh, flow, n), n, flow.steps, alone.mesh.vertices));
    return simulated;
}

void print_simulated_ranks(std::ostream& out, const SimulatedRanks& simulated)
{
    out << "counted, on threads of one process:\n"
           "  ranks  sub-meshes  most vertices  on average  messages      MB  iterations  same bits\n";
    for (const RankCounts& counts : simulated.counts)
        out << fmt::format(
            "  {:5}  {:10}  {:13}  {:10.0f}  {:8}  {:6.3f}  {:>10}  {:>9}\n", counts.ranks, counts.sub_meshes,
            counts.most_vertices, counts.mean_vertices, counts.messages, static_cast<double>(counts.bytes) / 1e6,
            counts.iterations ? std::to_string(*counts.iterations) : "-", counts.same_bits ? "yes" : "NO");
    const RankCounts& last = simulated.counts.back();
    if (last.messages == 0)
        return;
    const double per_vertex = simulated.seconds_per_vertex / cores;
    const double m = 1e9 / machines;
    out << fmt::format("a model, not a measurement: 1e9 vertices on {} machines of {} cores, a step in {:.3g} us a "
                       "vertex and core (measured), messages as with {} ranks\n",
                       machines, cores, 1e6 * simulated.seconds_per_vertex, last.ranks);
    for (const Network& network : networks) {
        const double told = network_seconds(last, network, m);
        const double even = vertices_where_even(last, network, per_vertex);
        out << fmt::format(
            "  {}: {:.3g} s of computing, {:.3g} s of messages; equally long at {:.2g} vertices per machine\n",
            network.name, m * per_vertex, told, even);
    }
}

nlohmann::ordered_json simulated_ranks_json(const SimulatedRanks& simulated)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const RankCounts& counts : simulated.counts) {
        list.push_back({{"ranks", counts.ranks},
                        {"sub_meshes", counts.sub_meshes},
                        {"most_vertices", counts.most_vertices},
                        {"mean_vertices", counts.mean_vertices},
                        {"messages", counts.messages},
                        {"bytes", counts.bytes}});
        if (counts.iterations)
            list.back()["iterations"] = *counts.iterations;
        list.back()["same_bits"] = counts.same_bits;
    }
    return {{"simulated_ranks", list}, {"seconds_per_vertex", simulated.seconds_per_vertex}};
}

}  // namespace seamflow
