#include "partition/cut/repair.h"

#include <numeric>
#include <utility>

#include "partition/cut/compact.h"
#include "partition/cut/merge.h"
#include "partition/cut/pieces.h"
#include "partition/cut/pinches.h"
#include "partition/index.h"

namespace seamflow {

namespace {

/// Cuts by METIS need two or three rounds; a cut that needs more than this gets its pinched parts merged.
constexpr int max_rounds = 12;

/// Vertices to look at, each once.
class VertexQueue {
  public:
    explicit VertexQueue(Index n_vertices)
        : queued_(at(n_vertices), true)
        , vertices_(at(n_vertices))
    {
        std::iota(vertices_.begin(), vertices_.end(), 0);
    }

    void add_corners_of(const PolygonMesh& mesh, const std::vector<Index>& faces)
    {
        for (const Index f : faces)
            for (const Index v : mesh.face(f))
                if (!queued_[at(v)]) {
                    queued_[at(v)] = true;
                    vertices_.push_back(v);
                }
    }

    /// Empties the queue. @returns what was in it.
    std::vector<Index> take()
    {
        for (const Index v : vertices_)
            queued_[at(v)] = false;
        return std::exchange(vertices_, {});
    }

  private:
    std::vector<bool> queued_;
    std::vector<Index> vertices_;
};

/// Mends loose pieces and pinches in turn, as either may cause the other. Leaves all parts connected.
void mend_in_rounds(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels)
{
    PinchMender mender(mesh, topology, labels, n_labels);
    VertexQueue queue(mesh.n_vertices());
    std::vector<bool> suspects(at(n_labels), true);
    for (int round = 0;; ++round) {
        queue.add_corners_of(mesh, join_loose_pieces(mesh, topology, suspects, labels));
        if (round == max_rounds)
            return;
        mender.count_faces();
        std::vector<Index> moved;
        std::vector<Index> robbed;
        for (const Index v : queue.take())
            mender.mend(v, moved, robbed);
        if (moved.empty())
            return;
        queue.add_corners_of(mesh, moved);
        suspects.assign(at(n_labels), false);
        for (const Index label : robbed)
            suspects[at(label)] = true;
    }
}

}  // namespace

Index repair(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels)
{
    Index n_labels = compact_labels(labels);
    const std::vector<Index> before = labels;
    n_labels = split_by_component(mesh, topology, n_labels, labels);
    mend_in_rounds(mesh, topology, n_labels, labels);
    merge_pinched(mesh, topology, n_labels, labels);
    Index n_moved = 0;
    for (std::size_t f = 0; f < labels.size(); ++f)
        n_moved += labels[f] != before[f] ? 1 : 0;
    compact_labels(labels);
    return n_moved;
}

}  // namespace seamflow
