#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Whether v may be pinched (see PinchMender), decided without walking around v; exact at interior vertices.
/// @param labels #F.
bool may_be_pinched(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& labels, Index v);

/// Finds and mends pinched vertices: vertices at which the faces of one part form several runs within one fan of the
/// mesh.
class PinchMender {
  public:
    /// @param mesh, topology, labels must outlive the object. @param n_labels all labels are below it.
    PinchMender(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, Index n_labels);

    /// Counts the faces of the parts. To be called before faces are moved or parts compared, and after outside changes
    /// of labels.
    void count_faces(const Executor& exec = run_serially);

    /// The number of excess runs at v: the number of runs minus the number of labels, summed over the fans of the mesh
    /// at v.
    Index pinches_at(Index v);

    /// Moves faces at v to other parts until v is not pinched, in small steps. Each step is the best of a few
    /// candidates, by the number of parts that it empties, the change of the number of pinches nearby, the number of
    /// faces moved and the change of the length of the cut.
    /// @param moved gets the faces that changed their label, @param labels_before the labels they had.
    void mend(Index v, std::vector<Index>& moved, std::vector<Index>& labels_before);

    /// A part pinched at v, and the smallest of the parts next to its runs there; the larger of the two first. v must
    /// be pinched.
    std::pair<Index, Index> pinched_and_between(Index v);

  private:
    /// Consecutive faces of one label: positions in their fan, which may wrap around.
    struct Run {
        Index label;
        std::size_t begin;
        std::size_t count;
    };
    /// Faces that get another label.
    struct Move {
        std::vector<Index> faces;
        Index label;
    };
    /// The cost of a move, most important first; compared in this order.
    struct Cost {
        /// The number of parts that lose their last face.
        Index parts_used_up;
        /// The change of the number of pinches at the vertices of the moved faces.
        Index pinches;
        /// The number of moved faces.
        std::size_t faces;
        /// The change of the length of the edges between parts.
        double cut_length;
        friend auto operator<=>(const Cost&, const Cost&) = default;
    };

    void find_runs(const Fan& fan);
    Index count_excess_runs();
    Fan find_pinch(Index v);
    void propose(const Fan& fan, std::size_t first_run, std::size_t last_run, Index label);
    void propose_filling(const Fan& fan);
    void propose_giving(const Fan& fan);
    Cost try_out(const Move& move);
    Index pinches_around(const std::vector<Index>& faces);
    [[nodiscard]] double cut_length_around(const std::vector<Index>& faces) const;
    void set_label(Index f, Index label);

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<Index>& labels_;
    /// One entry per label: its number of faces.
    std::vector<std::int64_t> n_faces_;
    /// One entry per label: the number of the last call of count_excess_runs in which a run had it. And the number of
    /// the present call.
    std::vector<std::size_t> last_call_with_label_;
    std::size_t call_ = 0;
    /// The runs of the fan examined last, in order; and the label that occurs in several runs.
    std::vector<Run> runs_;
    Index pinched_label_ = -1;
    /// The candidates for the present step.
    std::vector<Move> moves_;
    /// Scratch: vertices, and labels of faces before a move.
    std::vector<Index> nearby_;
    std::vector<Index> labels_before_;
};

/// Merges pairs of neighbouring parts at pinched vertices, the smaller into the larger, until no vertex is pinched.
/// Connected parts stay connected, and each round leaves fewer parts: at worst one for each connected component of the
/// mesh.
/// @param labels #F, from 0 to n_labels - 1; labels of parts that were merged into others no longer occur.
void merge_pinched(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
