#include "partition/cut/seams.h"

#include <algorithm>
#include <utility>

#include "partition/index.h"

namespace seamflow {

namespace {

struct Votes {
    Index label;
    Index count;
};

void vote(Index label, std::vector<Votes>& votes)
{
    for (Votes& candidate : votes)
        if (candidate.label == label) {
            ++candidate.count;
            return;
        }
    votes.push_back({label, 1});
}

/// The label that weighs most around face f: its own if no other one weighs more, else the lowest.
Index prevailing_label(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& labels, Index f,
                       std::vector<Votes>& votes)
{
    votes.assign(1, {labels[at(f)], 0});
    for (const Index v : mesh.face(f))
        if (topology.kind[at(v)] == VertexKind::Interior)
            for (const Index corner : topology.corners_at(v))
                vote(labels[at(topology.face_of[at(corner)])], votes);
    Votes best = votes.front();
    for (const Votes& candidate : votes)
        if (candidate.count > best.count ||
            (candidate.count == best.count && best.label != labels[at(f)] && candidate.label < best.label))
            best = candidate;
    return best.label;
}

/// Faces to look at in a round, each once.
class FaceList {
  public:
    explicit FaceList(const PolygonMesh& mesh)
        : listed_(at(mesh.n_faces()), false)
    {
    }

    void add_around(const Topology& topology, Index v)
    {
        for (const Index corner : topology.corners_at(v)) {
            const Index f = topology.face_of[at(corner)];
            if (!listed_[at(f)])
                faces_.push_back(f);
            listed_[at(f)] = true;
        }
    }

    /// Empties the list. @returns what was in it.
    std::vector<Index> take()
    {
        for (const Index f : faces_)
            listed_[at(f)] = false;
        return std::exchange(faces_, {});
    }

  private:
    std::vector<bool> listed_;
    std::vector<Index> faces_;
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

void straighten_seams(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, int rounds,
                      const Loop& loop)
{
    FaceList list(mesh);
    for (const Index v : mixed_vertices(topology, labels, loop))
        list.add_around(topology, v);
    std::vector<Index> prevailing;
    for (int round = 0; round < rounds; ++round) {
        // Round by round fewer: only around faces that have changed may others prevail.
        const std::vector<Index> faces = list.take();
        prevailing.resize(faces.size());
        loop(static_cast<Index>(faces.size()), [&](Index begin, Index end) {
            std::vector<Votes> votes;
            for (Index i = begin; i < end; ++i)
                prevailing[at(i)] = prevailing_label(mesh, topology, labels, faces[at(i)], votes);
        });
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const Index f = faces[i];
            if (labels[at(f)] == prevailing[i])
                continue;
            labels[at(f)] = prevailing[i];
            for (const Index v : mesh.face(f))
                list.add_around(topology, v);
        }
    }
}

}  // namespace seamflow
