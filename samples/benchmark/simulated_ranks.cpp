#include "samples/benchmark/simulated_ranks.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "engine/distributed/cut/distributed_cut.h"
#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/thread_transport.h"

namespace seamflow {

namespace {

struct RunOnRanks {
    Points positions;
    std::vector<RankReport> reports;
};

RunOnRanks run_on_ranks(const PolygonMesh& mesh, FlowOptions flow, int n)
{
    RunOnRanks run;
    run.reports.resize(n);
    flow.resources.threads = 1;
    run_on_threads(n, [&](Transport& transport) {
        RankSlice slice;
        MeshPart part;
        run_together(transport, [&](Communicator& comm) {
            slice = hand_out(comm, mesh, 1);
            cut_together(comm, slice, flow);
            part = deal(comm, slice);
        });
        FlowOptions options = flow;
        options.cut = {};
        RankReport report = distributed_mean_curvature_flow(transport, part, options);
        run_together(transport, [&](Communicator& comm) {
            collect_positions(comm, part.vertex_numbers, part.mesh.vertices, slice);
            Points positions = gather_positions(comm, slice.vertices);
            if (comm.rank() == 0)
                run.positions = std::move(positions);
        });
        run.reports[transport.rank()] = std::move(report);
    });
    return run;
}

RankCounts counts_of(const RunOnRanks& run, const Points& expected)
{
    RankCounts counts;
    counts.ranks = static_cast<int>(run.reports.size());
    counts.sub_meshes = run.reports.front().flow.cut.n_sub_meshes();
    for (const RankReport& rank : run.reports) {
        counts.most_vertices = std::max(counts.most_vertices, rank.vertices);
        counts.mean_vertices += static_cast<double>(rank.vertices) / counts.ranks;
        counts.messages = std::max(counts.messages, rank.traffic.back().messages);
        counts.bytes = std::max(counts.bytes, rank.traffic.back().bytes);
        counts.iterations = rank.flow.steps.back().iterations;
    }
    counts.same_bits = (run.positions.array() == expected.array()).all();
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
    for (const StepReport& step : alone.reports.front().flow.steps)
        seconds.push_back(step.seconds);
    std::ranges::sort(seconds);
    simulated.seconds_per_vertex = seconds[seconds.size() / 2] / mesh.n_vertices();
    for (const int n : ranks)
        simulated.counts.push_back(n == 1 ? counts_of(alone, alone.positions)
                                          : counts_of(run_on_ranks(mesh, flow, n), alone.positions));
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
