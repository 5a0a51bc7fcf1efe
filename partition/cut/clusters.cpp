#include "partition/cut/clusters.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "partition/cut/components.h"
#include "partition/index.h"

namespace seamflow {

namespace {

class ClusterGrower {
  public:
    ClusterGrower(const PolygonMesh& mesh, const Topology& topology, Index weight)
        : mesh_(mesh)
        , topology_(topology)
        , weight_(weight)
    {
        clusters_.cluster_of.assign(at(mesh.n_faces()), -1);
        clusters_.faces.values.reserve(at(mesh.n_faces()));
    }

    /// Fills the component of face f with clusters.
    void grow_component(Index f)
    {
        outer_.clear();
        grow_cluster(f);
        // Each next cluster begins beside the earliest face that has a free neighbour, so that few gaps remain.
        for (std::size_t front = 0; front < outer_.size(); ++front)
            for_each_free_neighbour(outer_[front], [&](Index g) {
                grow_cluster(g);
                return true;
            });
        ++clusters_.n_components;
    }

    [[nodiscard]] bool is_free(Index f) const { return clusters_.cluster_of[at(f)] < 0; }
    FaceClusters take() { return std::move(clusters_); }

  private:
    std::vector<Index>& faces() { return clusters_.faces.values; }

    /// Until `visit` returns false.
    template <class Visit>
    void for_each_free_neighbour(Index f, Visit&& visit)
    {
        for (Index h = mesh_.face_offsets[at(f)]; h < mesh_.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology_.twin[at(h)];
            if (twin >= 0 && is_free(topology_.face_of[at(twin)]) && !visit(topology_.face_of[at(twin)]))
                return;
        }
    }

    void grow_cluster(Index seed)
    {
        Index left = weight_;
        const auto add = [&](Index f) {
            clusters_.cluster_of[at(f)] = clusters_.size();
            faces().push_back(f);
            left -= face_weight(mesh_, f);
            return left > 0;
        };
        std::size_t next = faces().size();
        for (add(seed); left > 0 && next < faces().size(); ++next)
            for_each_free_neighbour(faces()[next], add);
        // With notches filled and what would remain alone taken in, outlines are shorter and clusters fewer. All faces
        // that the growth has gone past but the last have no free neighbours any more.
        for (next = std::max(next, at(clusters_.faces.offsets.back()) + 1) - 1; next < faces().size(); ++next) {
            for_each_free_neighbour(faces()[next], [&](Index g) {
                if (belongs_to_last(g))
                    add(g);
                return true;
            });
            outer_.push_back(faces()[next]);
        }
        clusters_.faces.close();
        clusters_.component_of.push_back(clusters_.n_components);
    }

    /// Whether most edges of a free face lead to the cluster in the making, whose outline it would shorten, or none to
    /// a free face.
    [[nodiscard]] bool belongs_to_last(Index f) const
    {
        Index inner = 0;
        Index shared = 0;
        Index n_free = 0;
        for (Index h = mesh_.face_offsets[at(f)]; h < mesh_.face_offsets[at(f) + 1]; ++h) {
            if (topology_.twin[at(h)] < 0)
                continue;
            const Index cluster = clusters_.cluster_of[at(topology_.face_of[at(topology_.twin[at(h)])])];
            ++inner;
            shared += cluster == clusters_.size() ? 1 : 0;
            n_free += cluster < 0 ? 1 : 0;
        }
        return n_free == 0 || 2 * shared > inner;
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    Index weight_;
    FaceClusters clusters_;
    /// Of the component in hand: the faces of clusters that may have free neighbours, in order.
    std::vector<Index> outer_;
};

/// Face f is cluster f.
FaceClusters one_face_each(const PolygonMesh& mesh, const Topology& topology)
{
    FaceClusters clusters;
    clusters.cluster_of.resize(at(mesh.n_faces()));
    std::iota(clusters.cluster_of.begin(), clusters.cluster_of.end(), 0);
    clusters.faces.values = clusters.cluster_of;
    clusters.faces.offsets = clusters.cluster_of;
    clusters.faces.offsets.push_back(mesh.n_faces());
    FaceComponents components = face_components(mesh, topology);
    clusters.component_of = std::move(components.component);
    clusters.n_components = components.count;
    return clusters;
}

}  // namespace

FaceClusters grow_clusters(const PolygonMesh& mesh, const Topology& topology, Index weight)
{
    if (weight == 1)
        return one_face_each(mesh, topology);
    ClusterGrower grower(mesh, topology, weight);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (grower.is_free(f))
            grower.grow_component(f);
    return grower.take();
}

}  // namespace seamflow
