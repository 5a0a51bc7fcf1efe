#include "partition/cut/part_boundaries.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "partition/connected_components.h"
#include "partition/cut/clusters.h"
#include "partition/cut/refine.h"
#include "partition/index.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// Later rounds move hardly any faces.
constexpr int max_shortening_rounds = 8;

/// Moves single faces between parts (see shorten_boundaries).
class BoundaryShortener {
  public:
    BoundaryShortener(const PolygonMesh& mesh, const Topology& topology, const std::vector<std::int64_t>& weights,
                      std::vector<Index>& labels)
        : mesh_(mesh)
        , topology_(topology)
        , labels_(labels)
        , weight_(weights)
        , shared_(weights.size(), 0)
        , may_be_divided_(weights.size(), false)
    {
    }

    [[nodiscard]] bool is_beside_boundary(Index f) const
    {
        bool beside = false;
        for_each_neighbour(mesh_, topology_, f, [&](Index, Index g) { beside = beside || labels_[g] != labels_[f]; });
        return beside;
    }

    /// Moves face f to a better part.
    /// @returns whether the face changed its label.
    bool improve(Index f)
    {
        const Index own = labels_[f];
        candidates_.assign(1, own);
        for_each_neighbour(mesh_, topology_, f, [&](Index, Index g) {
            const Index label = labels_[g];
            if (shared_[label]++ == 0 && label != own)
                candidates_.push_back(label);
        });
        Index best = own;
        for (const Index label : candidates_)
            if (label != own && may_move(f, own, label) && is_better(f, label, best))
                best = label;
        // If the face has only one edge to its part, the rest of the part stays connected.
        if (best != own && shared_[own] > 1)
            may_be_divided_[own] = true;
        for (const Index label : candidates_)
            shared_[label] = 0;
        weight_.move(face_weight(mesh_, f), own, best);
        labels_[f] = best;
        return best != own;
    }

    /// One entry per label: whether faces that may have connected the part have left it.
    [[nodiscard]] const std::vector<bool>& may_be_divided() const { return may_be_divided_; }

  private:
    /// Whether the weights of the two parts allow that face f moves.
    [[nodiscard]] bool may_move(Index f, Index from, Index to) const
    {
        const Index weight = face_weight(mesh_, f);
        return weight_.relieves(weight, from, to) || weight_.stay_balanced(weight, from, to);
    }

    /// Whether face f is at the outline of its part: at the vertices of f that are on no edge to a face of part
    /// `label`, all faces are of f's own part. Then the own part is not divided or pinched if f leaves it.
    [[nodiscard]] bool is_outermost(Index f, Index label) const
    {
        const auto leads_to_label = [&](Index h) {
            const Index twin = topology_.twin[h];
            return twin >= 0 && labels_[topology_.face_of[twin]] == label;
        };
        for (Index h = mesh_.face_offsets[f]; h < mesh_.face_offsets[f + 1]; ++h)
            if (!leads_to_label(h) && !leads_to_label(topology_.previous(mesh_, h)) &&
                is_mixed(topology_, labels_, mesh_.face_vertices[h]))
                return false;
        return true;
    }

    /// Whether f is better off in `label` than in `other`.
    [[nodiscard]] bool is_better(Index f, Index label, Index other) const
    {
        // One edge more may be cut for better balance.
        if (other == labels_[f] && shared_[label] + 1 == shared_[other] &&
            weight_.relieves(face_weight(mesh_, f), other, label))
            return is_outermost(f, label);
        if (shared_[label] != shared_[other])
            return shared_[label] > shared_[other];
        // As many edges: the part is better that is lighter with f in it. The weight of its own part includes f
        // already.
        const Index weight = other == labels_[f] ? face_weight(mesh_, f) : 0;
        return weight_[label] + weight < weight_[other];
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<Index>& labels_;
    PartWeights weight_;
    /// One entry per label, 0 between calls: the number of edges that the current face shares with the part.
    std::vector<Index> shared_;
    std::vector<bool> may_be_divided_;
    /// Scratch: the label of the current face, and the other labels of its neighbours.
    std::vector<Index> candidates_;
};

}  // namespace

SuspectedDefects shorten_boundaries(const PolygonMesh& mesh, const Topology& topology, Index n_labels,
                                    std::vector<Index>& labels, const Executor& exec)
{
    const auto weights = sums_by_value(
        exec, mesh.n_faces(), n_labels, [&](Index f) { return labels[f]; },
        [&](Index f) { return face_weight(mesh, f); });
    if (weights.size() < 2)
        return {.parts = std::vector<bool>(weights.size(), false), .faces = {}};
    BoundaryShortener shortener(mesh, topology, weights, labels);
    auto faces = select(exec, mesh.n_faces(), [&](Index f) { return shortener.is_beside_boundary(f); });
    std::vector<Index> suspected = faces;
    for (int round = 0; round < max_shortening_rounds && !faces.empty(); ++round) {
        // In the next round, only faces around moved faces are tried.
        std::vector<Index> next;
        for (const Index f : faces)
            if (shortener.improve(f))
                for_each_neighbour(mesh, topology, f, [&](Index, Index g) { next.push_back(g); });
        sort_unique(next);
        faces = std::move(next);
        suspected.insert(suspected.end(), faces.begin(), faces.end());
    }
    return {.parts = shortener.may_be_divided(), .faces = std::move(suspected)};
}

}  // namespace seamflow
