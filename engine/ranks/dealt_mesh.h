#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/ranks/packing.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// What one rank knows of a mesh that flows: its sub-meshes and two layers of faces around them, in the order of the
/// whole mesh.
struct DealtMesh {
    PolygonMesh mesh;
    /// As in the whole mesh, except at the rim of what is known.
    Topology topology;
    /// #V, ascending: the vertices of the whole mesh.
    std::vector<Index> vertex_numbers;
    /// #V: 1 where rank 0 gets the position of the vertex from here.
    std::vector<std::uint8_t> is_sent;
    /// #V: ‖ΔV⁰‖; or empty.
    std::vector<double> curvature;
    /// #F: the place of the sub-mesh of each face among the known ones.
    std::vector<Index> labels;
    /// The known sub-meshes, ascending, and the first face of each, all as in the whole mesh.
    std::vector<Index> known;
    std::vector<Index> first_faces;
    /// The rank of each sub-mesh of the whole mesh.
    std::vector<Index> holders;
    /// A copy of the fields of the options that steps read; the others are as by default.
    FlowOptions options;
};

/// Takes a mesh out of a message that a Dealer has made.
DealtMesh dealt_mesh(Unpacker& message);

/// Deals the sub-meshes of a mesh to ranks: each gets consecutive ones, with about equally many faces.
class Dealer {
  public:
    /// @param mesh, topology, options must outlive this. @param labels #F, each in 0 to n_parts - 1; must outlive this,
    /// too. @param curvature #V, or empty.
    Dealer(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts,
           const FlowOptions& options, std::vector<double> curvature, int n_ranks);

    /// Puts what a rank gets into its message; once for each rank, in any order.
    void deal(int rank, Packer& message);

    /// The rank of each sub-mesh.
    [[nodiscard]] const std::vector<Index>& holders() const { return holders_; }

    /// Per rank that has been dealt its part: the vertices that it knows, and those whose positions come from it, both
    /// ascending.
    [[nodiscard]] std::vector<std::vector<Index>>& known_vertices() { return known_vertices_; }
    [[nodiscard]] std::vector<std::vector<Index>>& sent_vertices() { return sent_vertices_; }

  private:
    [[nodiscard]] std::vector<Index> known_faces(int rank);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    std::span<const Index> labels_;
    const FlowOptions* options_;
    std::vector<double> curvature_;
    /// The faces of each sub-mesh.
    std::vector<std::vector<Index>> faces_;
    std::vector<Index> holders_;
    /// #V: the rank that has all faces of the vertex; below 0 if there is none.
    std::vector<std::int32_t> holder_at_;
    /// #V: the rank that sends the position of the vertex to rank 0; -1: none yet.
    std::vector<std::int32_t> sender_;
    /// #F and #V: the last rank that knows the face, has looked around the vertex, and has got it.
    std::vector<std::int32_t> knows_face_;
    std::vector<std::int32_t> knows_vertex_;
    std::vector<std::int32_t> meets_vertex_;
    /// #V: the place of the vertex among those of the last rank that has it.
    std::vector<Index> place_;
    std::vector<std::vector<Index>> known_vertices_;
    std::vector<std::vector<Index>> sent_vertices_;
};

}  // namespace seamflow
