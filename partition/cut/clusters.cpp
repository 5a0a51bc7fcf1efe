#include "partition/cut/clusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "partition/connected_components.h"
#include "partition/large_arrays.h"

namespace seamflow {

namespace {

/// The total face_weight below which meshes are divided face by face, which takes a fraction of a second and gives the
/// best boundaries; heavier meshes are divided by clusters.
constexpr double min_weight_for_clusters = 500'000;
/// Parts of less weight than this are small: their boundaries matter less, so that lighter meshes are divided by
/// clusters, too.
constexpr double small_part = 5'000;
/// Like min_weight_for_clusters, for meshes that are divided into small parts.
constexpr double min_weight_for_small_parts = 300'000;
/// The approximate number of clusters that METIS gets per part: enough to shape the part well and to balance parts
/// within a few percent.
constexpr double clusters_per_part = 80;
/// The least total number of clusters, which takes METIS a twentieth of a second.
constexpr double min_clusters = 20'000;
/// The largest weight of a cluster. Larger clusters save no time and leave longer boundaries between parts.
constexpr double max_cluster_weight = 64;
/// The least weight of a cluster. Smaller clusters save little time compared with single faces.
constexpr double min_cluster_weight = 8;
/// The fewest clusters per part. If a part would have fewer, METIS gets every face.
constexpr double min_clusters_per_part = 30;

/// A range of consecutive faces.
struct Chunk {
    Index begin;
    Index end;

    [[nodiscard]] bool has(Index f) const { return f >= begin && f < end; }
};

/// Clusters whose faces are stored one cluster after the other in an array of all faces.
struct Grown {
    /// The index of the first face of the first cluster, and the index of the end of each cluster.
    Index begin = 0;
    std::vector<Index> ends;
    /// One entry per cluster: whether one of its edges leads to another chunk.
    std::vector<std::uint8_t> touches_others;

    [[nodiscard]] Index size() const { return static_cast<Index>(ends.size()); }
    [[nodiscard]] std::span<const Index> faces_of(Index cluster, const std::vector<Index>& faces) const
    {
        const Index first = cluster > 0 ? ends[cluster - 1] : begin;
        return std::span(faces).subspan(first, ends[cluster] - first);
    }
};

/// The output of a ClusterGrower.
struct ClusterRange {
    /// #F: the cluster of each face; negative if the face has no cluster yet.
    std::vector<Index>& cluster_of;
    /// #F: receives the faces of one cluster after the other.
    std::vector<Index>& faces;
    /// The number of the first cluster, and the index of its first face in `faces`.
    Index first = 0;
    Index begin = 0;
};

/// Fills a chunk of the faces with clusters. Does not read or write entries of other faces.
class ClusterGrower {
  public:
    ClusterGrower(const PolygonMesh& mesh, const Topology& topology, Index weight, Chunk chunk,
                  const ClusterRange& range)
        : mesh_(mesh)
        , topology_(topology)
        , weight_(weight)
        , chunk_(chunk)
        , first_(range.first)
        , cluster_of_(range.cluster_of)
        , faces_(range.faces)
        , grown_{.begin = range.begin, .ends = {}, .touches_others = {}}
        , end_(range.begin)
    {
    }

    /// Moves out the grown clusters; nothing can be grown after this.
    Grown take() { return std::move(grown_); }

    /// Grows clusters over all faces of the chunk that are connected to face f, unless f has a cluster.
    void grow_around(Index f)
    {
        if (!is_free(f))
            return;
        outer_.clear();
        grow_cluster(f);
        // Each further cluster begins beside the earliest face that has a free neighbour, so that few gaps remain.
        for (std::size_t front = 0; front < outer_.size(); ++front)
            for_each_free_neighbour(outer_[front], [&](Index g) {
                grow_cluster(g);
                return true;
            });
    }

  private:
    [[nodiscard]] bool is_free(Index f) const { return chunk_.has(f) && cluster_of_[f] < 0; }
    /// The number of the cluster being grown.
    [[nodiscard]] Index last() const { return first_ + grown_.size(); }

    /// Calls visit for neighbours of face f in the chunk that have no cluster; stops when `visit` returns false. Sets
    /// touches_others_ if it finds a neighbour in another chunk.
    template <class Visit>
    void for_each_free_neighbour(Index f, Visit&& visit)
    {
        for (Index h = mesh_.face_offsets[f]; h < mesh_.face_offsets[f + 1]; ++h) {
            const Index twin = topology_.twin[h];
            if (twin < 0)
                continue;
            const Index neighbour = topology_.face_of[twin];
            if (!chunk_.has(neighbour))
                touches_others_ = true;
            else if (cluster_of_[neighbour] < 0 && !visit(neighbour))
                return;
        }
    }

    /// Grows one cluster from the free face `seed`, and appends those of its faces that may have free neighbours to
    /// outer_.
    void grow_cluster(Index seed)
    {
        const Index begin = end_;
        touches_others_ = false;
        Index left = weight_;
        const auto add = [&](Index f) {
            cluster_of_[f] = last();
            faces_[end_++] = f;
            left -= face_weight(mesh_, f);
            return left > 0;
        };
        Index next = begin;
        for (add(seed); left > 0 && next < end_; ++next)
            for_each_free_neighbour(faces_[next], add);
        // Faces that fill notches, or would be isolated, are added to the cluster, which makes outlines shorter and
        // clusters fewer. Faces before the present one have no free neighbours left.
        for (next = std::max(next, begin + 1) - 1; next < end_; ++next) {
            for_each_free_neighbour(faces_[next], [&](Index g) {
                if (belongs_to_last(g))
                    add(g);
                return true;
            });
            outer_.push_back(faces_[next]);
        }
        grown_.ends.push_back(end_);
        grown_.touches_others.push_back(touches_others_ ? 1 : 0);
    }

    /// Whether the free face f should join the cluster being grown: most of its edges lead to the cluster, so that it
    /// shortens the outline, or none leads to a free face.
    [[nodiscard]] bool belongs_to_last(Index f) const
    {
        Index inner = 0;
        Index shared = 0;
        Index n_free = 0;
        for_each_neighbour(mesh_, topology_, f, [&](Index, Index neighbour) {
            ++inner;
            if (!chunk_.has(neighbour))
                return;
            shared += cluster_of_[neighbour] == last() ? 1 : 0;
            n_free += cluster_of_[neighbour] < 0 ? 1 : 0;
        });
        return n_free == 0 || 2 * shared > inner;
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    Index weight_;
    Chunk chunk_;
    Index first_;
    std::vector<Index>& cluster_of_;
    std::vector<Index>& faces_;
    Grown grown_;
    /// The cluster being grown: the end of its faces, and whether one of its edges leads to another chunk.
    Index end_;
    bool touches_others_ = false;
    /// The faces of the clusters of the present connected component that may have free neighbours, in order.
    std::vector<Index> outer_;
};

/// The fraction of the edges of a sample of faces that lead from one chunk of `size` faces to another.
double fraction_across(const PolygonMesh& mesh, const Topology& topology, Index size)
{
    constexpr Index faces_per_sample = 64;
    Index inner = 0;
    Index across = 0;
    for (Index f = 0; f < mesh.n_faces(); f += std::min(faces_per_sample, mesh.n_faces() - f))
        for_each_neighbour(mesh, topology, f, [&](Index, Index neighbour) {
            ++inner;
            across += neighbour / size != f / size ? 1 : 0;
        });
    return inner > 0 ? static_cast<double>(across) / inner : 0.0;
}

/// Divides all faces into chunks. They are larger, or a single one, if too many clusters would touch several chunks.
/// @param size of the smallest chunks.
std::vector<Chunk> chunks_of(const PolygonMesh& mesh, const Topology& topology, Index weight, Index size)
{
    // The largest product of the fraction of edges across chunks and the width of a cluster, which is about the square
    // root of its weight. About four times this product is the fraction of clusters that are grown again: a tenth.
    constexpr double most_widths_across = 0.025;
    const double width = std::sqrt(weight);
    while (size < mesh.n_faces() && width * fraction_across(mesh, topology, size) > most_widths_across)
        size = size <= mesh.n_faces() / 2 ? 2 * size : mesh.n_faces();
    std::vector<Chunk> chunks;
    for (Index begin = 0; begin < mesh.n_faces(); begin = chunks.back().end)
        chunks.push_back({begin, begin + std::min(size, mesh.n_faces() - begin)});
    return chunks;
}

/// Clusters of one face each.
FaceClusters one_face_each(const PolygonMesh& mesh)
{
    FaceClusters clusters;
    clusters.cluster_of.resize(mesh.n_faces());
    std::iota(clusters.cluster_of.begin(), clusters.cluster_of.end(), 0);
    clusters.faces.values = clusters.cluster_of;
    clusters.faces.offsets = clusters.cluster_of;
    clusters.faces.offsets.push_back(mesh.n_faces());
    return clusters;
}

/// Clusters that do not touch the ends of chunks.
struct InnerClusters {
    FaceClusters clusters;
    /// The other faces, whose cluster is -1, chunk by chunk.
    std::vector<Index> left_over;
};

/// Dissolves the clusters that touch other chunks and numbers the others in the order of chunks.
/// @param grown chunk by chunk, with clusters numbered from 0 in each. @param faces #F: the faces of the clusters.
InnerClusters keep_inner(const std::vector<Grown>& grown, std::vector<Index> faces, std::vector<Index> cluster_of,
                         const Executor& exec)
{
    InnerClusters inner;
    FaceClusters& clusters = inner.clusters;
    clusters.cluster_of = std::move(cluster_of);
    if (grown.size() == 1) {
        auto& offsets = clusters.faces.offsets;
        offsets.insert(offsets.end(), grown[0].ends.begin(), grown[0].ends.end());
        clusters.faces.values = std::move(faces);
        return inner;
    }
    clusters.faces.values = large_vector<Index>(faces.size());
    std::vector<Index> first_of_chunk;
    for (const Grown& chunk : grown) {
        first_of_chunk.push_back(clusters.size());
        for (Index c = 0; c < chunk.size(); ++c)
            if (chunk.touches_others[c] == 0)
                clusters.faces.offsets.push_back(clusters.faces.offsets.back() +
                                                 static_cast<Index>(chunk.faces_of(c, faces).size()));
    }
    std::vector<std::vector<Index>> left_over(grown.size());
    for_each(exec, static_cast<Index>(grown.size()), [&](Index i) {
        const Grown& chunk = grown[i];
        Index number = first_of_chunk[i];
        for (Index c = 0; c < chunk.size(); ++c) {
            const auto of_cluster = chunk.faces_of(c, faces);
            const bool is_inner = chunk.touches_others[c] == 0;
            for (const Index f : of_cluster)
                clusters.cluster_of[f] = is_inner ? number : -1;
            if (is_inner)
                std::ranges::copy(of_cluster, clusters.faces.values.begin() + clusters.faces.offsets[number++]);
            else
                left_over[i].insert(left_over[i].end(), of_cluster.begin(), of_cluster.end());
        }
    });
    for (const std::vector<Index>& of_chunk : left_over)
        inner.left_over.insert(inner.left_over.end(), of_chunk.begin(), of_chunk.end());
    return inner;
}

}  // namespace

Index cluster_weight(double total, Index k)
{
    if (total < (total / k <= small_part ? min_weight_for_small_parts : min_weight_for_clusters))
        return 1;
    if (total / k < min_clusters_per_part * min_cluster_weight)
        return 1;
    return static_cast<Index>(
        std::clamp(total / std::max(k * clusters_per_part, min_clusters), min_cluster_weight, max_cluster_weight));
}

FaceClusters grow_clusters(const PolygonMesh& mesh, const Topology& topology, Index weight, const Executor& exec,
                           Index chunk)
{
    if (weight == 1)
        return one_face_each(mesh);
    std::vector<Index> cluster_of;
    std::vector<Index> faces;
    // Two independent tasks, at the same time if the executor has several threads.
    for_each(exec, 2, [&](Index one_of_both) {
        if (one_of_both == 0)
            cluster_of = large_vector<Index>(usize(mesh.n_faces()), -1);
        else
            faces = large_vector<Index>(usize(mesh.n_faces()));
    });
    const std::vector<Chunk> chunks = chunks_of(mesh, topology, weight, chunk);
    std::vector<Grown> grown(chunks.size());
    for_each(exec, static_cast<Index>(chunks.size()), [&](Index i) {
        const Chunk& own = chunks[i];
        ClusterGrower grower(mesh, topology, weight, own, {cluster_of, faces, 0, own.begin});
        for (Index f = own.begin; f < own.end; ++f)
            grower.grow_around(f);
        grown[i] = grower.take();
    });

    auto [clusters, left_over] = keep_inner(grown, std::move(faces), std::move(cluster_of), exec);
    const Chunk all{0, mesh.n_faces()};
    ClusterGrower grower(mesh, topology, weight, all,
                         {clusters.cluster_of, clusters.faces.values, clusters.size(), clusters.faces.offsets.back()});
    for (const Index f : left_over)
        grower.grow_around(f);
    const std::vector<Index> ends = grower.take().ends;
    clusters.faces.offsets.insert(clusters.faces.offsets.end(), ends.begin(), ends.end());
    return std::move(clusters);
}

}  // namespace seamflow
