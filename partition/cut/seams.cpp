#include "partition/cut/seams.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "partition/cut/clusters.h"
#include "partition/cut/refine.h"
#include "partition/index.h"

namespace seamflow {

namespace {

/// Hardly anything moves in later rounds.
constexpr int max_rounds = 8;

/// Calls visit(face across) for every edge of f that has one.
template <class Visit>
void for_each_neighbour(const PolygonMesh& mesh, const Topology& topology, Index f, Visit&& visit)
{
    for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h)
        if (const Index twin = topology.twin[at(h)]; twin >= 0)
            visit(topology.face_of[at(twin)]);
}

class SeamShortener {
  public:
    SeamShortener(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels,
                  const Loop& loop)
        : mesh_(mesh)
        , topology_(topology)
        , labels_(labels)
        , weight_(sums_by_value(
              loop, mesh.n_faces(), n_labels, [&](Index f) { return labels[at(f)]; },
              [&](Index f) { return face_weight(mesh, f); }))
        , shared_(at(n_labels), 0)
        , may_be_in_pieces_(at(n_labels), false)
    {
        const std::int64_t total = std::accumulate(weight_.begin(), weight_.end(), std::int64_t{0});
        const double mean = static_cast<double>(total) / n_labels;
        heaviest_ = static_cast<std::int64_t>(mean * (1.0 + balance_tolerance));
        lightest_ = static_cast<std::int64_t>(mean / (1.0 + balance_tolerance));
    }

    [[nodiscard]] bool is_beside_seam(Index f) const
    {
        bool beside = false;
        for_each_neighbour(mesh_, topology_, f, [&](Index g) { beside = beside || labels_[at(g)] != labels_[at(f)]; });
        return beside;
    }

    /// @returns whether the face changed its label.
    bool improve(Index f)
    {
        const Index own = labels_[at(f)];
        candidates_.assign(1, own);
        for_each_neighbour(mesh_, topology_, f, [&](Index g) {
            const Index label = labels_[at(g)];
            if (shared_[at(label)]++ == 0 && label != own)
                candidates_.push_back(label);
        });
        Index best = own;
        for (const Index label : candidates_)
            if (label != own && may_move(f, own, label) && is_better(f, label, best))
                best = label;
        // A face with one edge to its part leaves the rest of it connected.
        if (best != own && shared_[at(own)] > 1)
            may_be_in_pieces_[at(own)] = true;
        for (const Index label : candidates_)
            shared_[at(label)] = 0;
        weight_[at(own)] -= face_weight(mesh_, f);
        weight_[at(best)] += face_weight(mesh_, f);
        labels_[at(f)] = best;
        return best != own;
    }

    /// One entry per label: whether faces have left the part that may have held it together.
    [[nodiscard]] const std::vector<bool>& may_be_in_pieces() const { return may_be_in_pieces_; }

  private:
    [[nodiscard]] bool may_move(Index f, Index from, Index to) const
    {
        const Index weight = face_weight(mesh_, f);
        return relieves(f, from, to) ||
               (weight_[at(to)] + weight <= heaviest_ && weight_[at(from)] - weight >= lightest_);
    }

    /// Whether a part that is too heavy would give a face to a lighter one, or one that is too light get it.
    [[nodiscard]] bool relieves(Index f, Index from, Index to) const
    {
        return (weight_[at(from)] > heaviest_ || weight_[at(to)] < lightest_) &&
               weight_[at(to)] + face_weight(mesh_, f) < weight_[at(from)];
    }

    /// Whether those vertices of f that no edge to a face of the part lies at have faces of f's own part alone, so that
    /// this is not divided or pinched when f leaves.
    [[nodiscard]] bool is_outermost(Index f, Index label) const
    {
        const auto leads_to_label = [&](Index h) {
            const Index twin = topology_.twin[at(h)];
            return twin >= 0 && labels_[at(topology_.face_of[at(twin)])] == label;
        };
        for (Index h = mesh_.face_offsets[at(f)]; h < mesh_.face_offsets[at(f) + 1]; ++h)
            if (!leads_to_label(h) && !leads_to_label(topology_.previous(mesh_, h)) &&
                is_mixed(topology_, labels_, mesh_.face_vertices[at(h)]))
                return false;
        return true;
    }

    /// Than to stay with, or go to, `other`.
    [[nodiscard]] bool is_better(Index f, Index label, Index other) const
    {
        if (other == labels_[at(f)] && shared_[at(label)] + 1 == shared_[at(other)] && relieves(f, other, label))
            return is_outermost(f, label);
        if (shared_[at(label)] != shared_[at(other)])
            return shared_[at(label)] > shared_[at(other)];
        const Index weight = other == labels_[at(f)] ? face_weight(mesh_, f) : 0;
        return weight_[at(label)] + weight < weight_[at(other)];
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<Index>& labels_;
    /// One entry per label.
    std::vector<std::int64_t> weight_;
    std::int64_t heaviest_ = 0;
    std::int64_t lightest_ = 0;
    /// One entry per label, 0 between faces: how many edges the face in hand shares with the part.
    std::vector<Index> shared_;
    std::vector<bool> may_be_in_pieces_;
    std::vector<Index> candidates_;
};

}  // namespace

bool is_mixed(const Topology& topology, const std::vector<Index>& labels, Index v)
{
    const auto corners = topology.corners_at(v);
    return std::any_of(corners.begin(), corners.end(), [&](Index corner) {
        return labels[at(topology.face_of[at(corner)])] != labels[at(topology.face_of[at(corners.front())])];
    });
}

std::vector<Index> mixed_vertices(const Topology& topology, const std::vector<Index>& labels, const Loop& loop)
{
    return select(loop, static_cast<Index>(topology.kind.size()),
                  [&](Index v) { return is_mixed(topology, labels, v); });
}

Doubts shorten_seams(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels,
                     const Loop& loop)
{
    if (n_labels < 2)
        return {.parts = std::vector<bool>(at(n_labels), false), .faces = {}};
    SeamShortener shortener(mesh, topology, n_labels, labels, loop);
    auto faces = select(loop, mesh.n_faces(), [&](Index f) { return shortener.is_beside_seam(f); });
    std::vector<Index> doubtful = faces;
    for (int round = 0; round < max_rounds && !faces.empty(); ++round) {
        // Only around faces that have moved may others follow.
        std::vector<Index> next;
        for (const Index f : faces)
            if (shortener.improve(f))
                for_each_neighbour(mesh, topology, f, [&](Index g) { next.push_back(g); });
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        faces = std::move(next);
        doubtful.insert(doubtful.end(), faces.begin(), faces.end());
    }
    return {.parts = shortener.may_be_in_pieces(), .faces = std::move(doubtful)};
}

}  // namespace seamflow
