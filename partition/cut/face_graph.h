#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/connected_components.h"
#include "partition/cut/clusters.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The dual graph of a mesh, or a coarser one, in compressed rows: one node per cluster of faces, an arc each way
/// between two clusters that share edges. Arcs of a node are in ascending order of their targets; there are no
/// duplicate arcs and no loops.
struct FaceGraph {
    /// #nodes + 1; the arcs of node i have the indices offsets[i] to offsets[i + 1] - 1.
    std::vector<Index> offsets{0};
    /// #arcs: the node to which an arc leads.
    std::vector<Index> targets;
    /// #arcs, at least 1: the length or number of all shared edges, in a unit in which the mean is about 64, or less in
    /// the largest graphs (see max_weight_sum). Equal both ways.
    std::vector<Index> arc_weights;
    /// #nodes, at least 1: the weight of its faces (see face_weight), in larger units for the largest meshes.
    std::vector<Index> node_weights;

    [[nodiscard]] Index n_nodes() const { return static_cast<Index>(offsets.size()) - 1; }

    /// The nodes to which the arcs of a node lead.
    [[nodiscard]] std::span<const Index> neighbours(Index node) const
    {
        const std::size_t begin = usize(offsets[node]);
        return std::span<const Index>(targets).subspan(begin, usize(offsets[node + 1]) - begin);
    }
};

/// The largest sum of all arc weights, and of all node weights, of a graph.
inline constexpr double max_weight_sum = 1e9;

/// The cost of cutting an arc.
enum class ArcMeasure {
    /// The length of the shared edges.
    Length,
    /// The number of shared edges, which is about the number of vertices that will lie on the interface.
    Count,
};

/// The graph of the clusters of a mesh.
FaceGraph make_face_graph(const PolygonMesh& mesh, const Topology& topology, const FaceClusters& clusters,
                          ArcMeasure measure, const Executor& exec = run_serially);

/// The connected components of a graph.
Components graph_components(const FaceGraph& graph);

/// The subgraphs of the parts of a graph, without the arcs between parts. The nodes of each part keep their order.
/// @param part_of #nodes, from 0 to n_parts - 1.
std::vector<FaceGraph> induced_subgraphs(const FaceGraph& graph, std::span<const Index> part_of, Index n_parts);

}  // namespace seamflow
