#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Counts of the work and messages of ranks that share steps: with more ranks than cores nothing can be timed.
struct RankCounts {
    int ranks = 0;
    Index sub_meshes = 0;
    /// Vertices of the rank that has most, and the mean over all ranks.
    Index most_vertices = 0;
    double mean_vertices = 0.0;
    /// Of one step on average, of the rank that sends most.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    /// Of a converged step.
    std::optional<int> iterations = {};
    /// Whether all positions are those of the first of these runs.
    bool same_bits = false;
};

/// The results of flows on ranks.
struct SimulatedRanks {
    std::vector<RankCounts> counts;
    /// A step of one rank in one thread, seconds a vertex.
    double seconds_per_vertex = 0.0;
};

/// Runs the flow once for each number of ranks, which are threads of this process, and before that with one.
/// @param flow with steps, a time step, and conditions that ranks can share.
/// @throws as mean_curvature_flow.
SimulatedRanks simulate_ranks(const PolygonMesh& mesh, const FlowOptions& flow, const std::vector<int>& ranks);

/// Prints the counts, and a prediction from them for large meshes, by a model: a step takes the time of its vertices,
/// on all cores of a machine, and then the time of its messages, one after the other. The bytes that a rank sends grow
/// with the square root of its vertices; so do the messages of sweeps, one for each sub-mesh at its border. The number
/// of messages per iteration of converged steps does not depend on the number of vertices of a rank.
void print_simulated_ranks(std::ostream& out, const SimulatedRanks& simulated);

/// {"simulated_ranks": [{"ranks", "sub_meshes", "most_vertices", "mean_vertices", "messages", "bytes", "iterations",
/// "same_bits"}, …], "seconds_per_vertex"}; "iterations" of converged steps alone
nlohmann::ordered_json simulated_ranks_json(const SimulatedRanks& simulated);

}  // namespace seamflow
