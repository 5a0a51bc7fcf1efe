#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The dual graph of a set of faces in compressed rows: one node per face, an arc each way between two faces that
/// share edges. Arcs of a node are in ascending order of their targets; no arc is double, none leads to its own node.
struct FaceGraph {
    /// #nodes + 1; the arcs of node i are those from offsets[i] to offsets[i + 1] - 1.
    std::vector<Index> offsets{0};
    /// #arcs; the node an arc leads to.
    std::vector<Index> targets;
    /// #arcs, at least 1: the length of all shared edges, in a unit in which the mean is about 64. Equal both ways.
    std::vector<Index> arc_weights;
    /// #nodes: the number of triangles the face could be split into, which is about its share of the unknowns.
    std::vector<Index> node_weights;

    [[nodiscard]] Index n_nodes() const { return static_cast<Index>(offsets.size()) - 1; }
};

/// Neither the arc weights nor the node weights of a graph add up to more than this.
inline constexpr double max_weight_sum = 1e9;

/// Makes dual graphs of sets of faces, node i being faces[i]. Edges to faces outside the set are left out. A graph
/// costs time in proportion to its own size, not to the mesh's.
class FaceGraphMaker {
  public:
    /// The mesh and its topology must outlive the object.
    FaceGraphMaker(const PolygonMesh& mesh, const Topology& topology);

    /// @param faces distinct faces of the mesh.
    FaceGraph make(std::span<const Index> faces);

  private:
    struct Arc;

    void collect_arcs(Index f, std::vector<Arc>& arcs) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    /// #F: the node of a face in the graph in hand; -1 between calls.
    std::vector<Index> node_of_;
};

}  // namespace seamflow
