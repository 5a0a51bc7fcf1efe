#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ranks/packing.h"
#include "engine/setup/step_settings.h"
#include "engine/setup/way_of_steps.h"
#include "partition/cut/cut.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The part of a flowing mesh that one rank knows: its sub-meshes and two layers of faces around them, in the order of
/// the whole mesh.
struct DealtMesh {
    PolygonMesh mesh;
    /// As in the whole mesh, except at the rim of the known part.
    Topology topology;
    /// #V: the numbers of the vertices in the whole mesh, ascending.
    std::vector<Index> vertex_numbers;
    /// #V: 1 if rank 0 gets the position of the vertex from this rank.
    std::vector<std::uint8_t> is_sent;
    /// #V: ‖ΔV⁰‖, in 1/length; or empty.
    std::vector<double> curvature;
    /// #F: the sub-mesh of each face, as an index in `known`.
    std::vector<Index> labels;
    /// The numbers of the known sub-meshes in the whole mesh, ascending; and the first face of each, numbered as in the
    /// whole mesh.
    std::vector<Index> known;
    std::vector<Index> first_faces;
    /// The rank of each sub-mesh of the whole mesh.
    std::vector<Index> holders;
    /// Sweeps or converged steps.
    WayOfSteps way;
    /// The settings, except FlowTerms::initial, weights and strengths, which are empty here: see settings().
    StepSettings settings_without_arrays;
    /// Each #V or empty: see FlowTerms::weights and strengths.
    std::vector<double> weights;
    std::vector<double> strengths;

    /// The complete settings, which refer to the vertices, weights and strengths of this object.
    [[nodiscard]] StepSettings settings() const;
};

/// Reads a DealtMesh from a message that a Dealer has made.
DealtMesh dealt_mesh(Unpacker& message);

/// Deals the sub-meshes of a mesh to ranks: each rank gets consecutive sub-meshes, with about equally many faces.
class Dealer {
  public:
    /// @param mesh, topology, cut, way, settings must outlive this. @param curvature #V: ‖ΔV⁰‖, in 1/length; or empty.
    Dealer(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const WayOfSteps& way,
           const StepSettings& settings, std::vector<double> curvature, int n_ranks);

    /// Puts the part of a rank into the message for it; to be called once for each rank, in any order.
    void deal(int rank, Packer& message);

    /// The rank of each sub-mesh.
    [[nodiscard]] const std::vector<Index>& holders() const { return holders_; }

    /// Per rank that has been dealt its part: the vertices that it knows; and the vertices whose positions it sends to
    /// rank 0; both ascending.
    [[nodiscard]] std::vector<std::vector<Index>>& known_vertices() { return known_vertices_; }
    [[nodiscard]] std::vector<std::vector<Index>>& sent_vertices() { return sent_vertices_; }

  private:
    [[nodiscard]] std::vector<Index> known_faces(int rank);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    std::span<const Index> labels_;
    const WayOfSteps* way_;
    const StepSettings* settings_;
    std::vector<double> curvature_;
    /// The faces of each sub-mesh.
    std::vector<std::vector<Index>> faces_;
    std::vector<Index> holders_;
    /// #V: the rank that owns all faces of the vertex; -1 without faces, -2 if they belong to several ranks.
    std::vector<std::int32_t> holder_at_;
    /// #V: the rank that sends the position of the vertex to rank 0; -1 if none has been chosen.
    std::vector<std::int32_t> sender_;
    /// #F: a mark: the last rank that was dealt a part with the face; -1: none.
    std::vector<std::int32_t> knows_face_;
    /// #V: a mark: the last rank for which known_faces has visited the faces around the vertex; -1: none.
    std::vector<std::int32_t> visits_vertex_;
    /// #V: a mark: the last rank that was dealt a part with the vertex; -1: none.
    std::vector<std::int32_t> knows_vertex_;
    /// #V: the index of the vertex in the part that is being dealt, for vertices of this part.
    std::vector<Index> local_index_;
    std::vector<std::vector<Index>> known_vertices_;
    std::vector<std::vector<Index>> sent_vertices_;
};

}  // namespace seamflow
