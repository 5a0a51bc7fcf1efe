#include "engine/distributed/cut/chunk_cut.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/distributed/cut/cluster_division.h"
#include "engine/distributed/parts/element_ranges.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/cut/clusters.h"
#include "partition/cut/face_graph.h"
#include "partition/cut/part_boundaries.h"
#include "partition/labels.h"
#include "partition/repair/pinches.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// Clusters of all ranks, numbered chunk by chunk.
struct Clusters {
    std::vector<FaceClusters> of_chunk;
    /// One entry per chunk of this rank: the number of its first cluster.
    std::vector<Index> first;
    ClusterShare share;
};

Clusters grow_in_chunks(Communicator& comm, const std::vector<Chunk>& chunks, Index weight)
{
    Clusters clusters;
    for (const Chunk& chunk : chunks) {
        const PolygonMesh& mesh = chunk.part.mesh;
        const FaceClusters& grown = clusters.of_chunk.emplace_back(
            grow_clusters(mesh, chunk.topology, weight, run_in_parallel, mesh.n_faces()));
        for (Index cluster = 0; cluster < grown.size(); ++cluster) {
            std::int64_t total = 0;
            for (const Index f : grown.faces[cluster])
                total += face_weight(mesh, f);
            clusters.share.weights.push_back(total);
        }
        clusters.share.of_chunk.push_back(grown.size());
    }
    clusters.share.bounds = gather_bounds_of(comm, std::ssize(clusters.share.weights));
    auto next = static_cast<Index>(clusters.share.bounds[comm.rank()]);
    for (const FaceClusters& grown : clusters.of_chunk) {
        clusters.first.push_back(next);
        next += grown.size();
    }
    return clusters;
}

/// An edge of two faces, numbered in the whole mesh, and the cluster of one of them.
struct SharedEdge {
    Number low;
    Number high;
    Index cluster;
};

ClusterContact contact(Index one, Index other)
{
    return {std::min(one, other), std::max(one, other), 1};
}

/// Adds up the contacts between the same clusters.
void add_up(std::vector<ClusterContact>& contacts)
{
    const auto key = [](const ClusterContact& c) { return std::pair(c.low, c.high); };
    std::ranges::sort(contacts, {}, key);
    std::size_t n = 0;
    for (const ClusterContact& next : contacts)
        if (n > 0 && key(contacts[n - 1]) == key(next))
            contacts[n - 1].n_edges += next.n_edges;
        else
            contacts[n++] = next;
    contacts.resize(n);
}

/// Contacts between the clusters of each chunk.
std::vector<ClusterContact> contacts_within(const std::vector<Chunk>& chunks, const Clusters& clusters)
{
    std::vector<ClusterContact> all;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        const Topology& topology = chunks[i].topology;
        const std::vector<Index>& cluster_of = clusters.of_chunk[i].cluster_of;
        std::vector<ClusterContact> contacts;
        for (Index h = 0; h < chunks[i].part.mesh.n_corners(); ++h) {
            const Index twin = topology.twin[h];
            if (twin < h)
                continue;
            const Index one = cluster_of[topology.face_of[h]];
            const Index other = cluster_of[topology.face_of[twin]];
            if (one != other)
                contacts.push_back(contact(clusters.first[i] + one, clusters.first[i] + other));
        }
        add_up(contacts);
        all.insert(all.end(), contacts.begin(), contacts.end());
    }
    return all;
}

/// Contacts between clusters of different chunks, at the homes of the lower ends of their edges.
std::vector<ClusterContact> contacts_across(Communicator& comm, const SliceBounds& bounds,
                                            const std::vector<Chunk>& chunks, const Clusters& clusters)
{
    std::vector<std::vector<SharedEdge>> to_homes(comm.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        const MeshPart& part = chunks[i].part;
        for (const Index h : chunks[i].crossing) {
            const Number one = part.vertex_numbers[part.mesh.face_vertices[h]];
            const Number other = part.vertex_numbers[part.mesh.face_vertices[chunks[i].topology.next(part.mesh, h)]];
            const Index cluster = clusters.of_chunk[i].cluster_of[chunks[i].topology.face_of[h]];
            const SharedEdge edge{std::min(one, other), std::max(one, other), clusters.first[i] + cluster};
            to_homes[range_of(bounds.vertices, edge.low)].push_back(edge);
        }
    }
    std::vector<Bytes> sent;
    for (const auto& edges : to_homes)
        sent.push_back(packed(edges));
    std::vector<SharedEdge> edges;
    for (const Bytes& bytes : comm.exchange(std::move(sent))) {
        const auto of_rank = unpacked<SharedEdge>(bytes);
        edges.insert(edges.end(), of_rank.begin(), of_rank.end());
    }
    std::ranges::sort(edges, {}, [](const SharedEdge& edge) { return std::pair(edge.low, edge.high); });
    std::vector<ClusterContact> contacts;
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
        contacts.push_back(contact(edges[i].cluster, edges[i + 1].cluster));
    add_up(contacts);
    return contacts;
}

/// @returns the parts whose faces have moved.
std::vector<Index> shorten_within(Chunk& chunk, const std::vector<std::int64_t>& weights)
{
    const PolygonMesh& mesh = chunk.part.mesh;
    BoundarySurroundings whole{.weights = weights, .held = {}};
    whole.held.resize(mesh.n_faces());
    for_each(run_in_parallel, mesh.n_faces(), [&](Index f) {
        const bool is_held = std::ranges::any_of(mesh.face(f), [&](Index v) { return chunk.is_shared[v] != 0; });
        whole.held[f] = is_held ? 1 : 0;
    });
    const SuspectedDefects found = shorten_boundaries(mesh, chunk.topology, whole, chunk.part.labels, run_in_parallel);
    std::vector<Index> parts;
    for (std::size_t label = 0; label < found.parts.size(); ++label)
        if (found.parts[label])
            parts.push_back(static_cast<Index>(label));
    return parts;
}

}  // namespace

ChunkCut cut_chunks(Communicator& comm, const SliceBounds& bounds, std::vector<Chunk>& chunks, double total_weight,
                    Index k, Index chunks_of_block)
{
    const Index weight = cluster_weight(total_weight, k);
    Clusters clusters = grow_in_chunks(comm, chunks, weight);
    clusters.share.contacts = contacts_within(chunks, clusters);
    const auto across = contacts_across(comm, bounds, chunks, clusters);
    clusters.share.contacts.insert(clusters.share.contacts.end(), across.begin(), across.end());
    const DividedClusters divided = divide_together(comm, clusters.share, k, chunks_of_block);
    ChunkCut cut{.n_parts = static_cast<Index>(divided.weights.size()),
                 .n_components = divided.n_components,
                 .suspects = divided.loose_parts};
    auto of_clusters = std::span(divided.labels);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        std::vector<Index>& of_faces = chunks[i].part.labels;
        for (std::size_t f = 0; f < of_faces.size(); ++f)
            of_faces[f] = of_clusters[clusters.of_chunk[i].cluster_of[f]];
        of_clusters = of_clusters.subspan(at(clusters.of_chunk[i].size()));
        if (weight == 1)
            continue;
        const std::vector<Index> divided_parts = shorten_within(chunks[i], divided.weights);
        cut.suspects.insert(cut.suspects.end(), divided_parts.begin(), divided_parts.end());
    }
    cut.suspects = comm.gather_all(cut.suspects);
    sort_unique(cut.suspects);
    return cut;
}

std::vector<std::int64_t> gather_pinch_candidates(Communicator& comm, const SliceBounds& bounds,
                                                  const std::vector<Chunk>& chunks)
{
    struct LabelAtVertex {
        Number vertex;
        Index label;
        bool operator<(const LabelAtVertex& other) const
        {
            return std::pair(vertex, label) < std::pair(other.vertex, other.label);
        }
        bool operator==(const LabelAtVertex&) const = default;
    };
    std::vector<Number> candidates;
    std::vector<std::vector<LabelAtVertex>> to_homes(comm.size());
    for (const auto& [part, topology, is_shared, crossing] : chunks) {
        for (Index f = 0; f < part.mesh.n_faces(); ++f)
            for (const Index v : part.mesh.face(f))
                if (is_shared[v] != 0) {
                    const Number vertex = part.vertex_numbers[v];
                    to_homes[range_of(bounds.vertices, vertex)].push_back({vertex, part.labels[f]});
                }
        for (Index v = 0; v < part.mesh.n_vertices(); ++v)
            if (is_shared[v] == 0 && may_be_pinched(part.mesh, topology, part.labels, v))
                candidates.push_back(part.vertex_numbers[v]);
    }
    std::vector<Bytes> sent;
    for (auto& labels : to_homes) {
        sort_unique(labels);
        sent.push_back(packed(labels));
    }
    std::vector<LabelAtVertex> labels;
    for (const Bytes& bytes : comm.exchange(std::move(sent))) {
        const auto of_rank = unpacked<LabelAtVertex>(bytes);
        labels.insert(labels.end(), of_rank.begin(), of_rank.end());
    }
    sort_unique(labels);
    for (std::size_t i = 1; i < labels.size(); ++i)
        if (labels[i].vertex == labels[i - 1].vertex)
            candidates.push_back(labels[i].vertex);
    std::vector<Number> all = comm.gather_at_first(candidates);
    sort_unique(all);
    return all;
}

}  // namespace seamflow
