#include "partition/metrics/edge_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "partition/disjoint_sets.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

namespace {

/// The edges of a spike are longer than this many of the other edges of their faces; also the ratio of edges in a
/// needle.
constexpr double least_in_edges = 10.0;
/// The edges of a spike are longer than this many diagonals of the box around its neighbours.
constexpr double least_in_boxes = 3.0;
/// A block with more vertices than this fraction of the block beside it is part of the shape of the surface.
constexpr double most_of_neighbour = 0.1;

double squared_length(const Points& positions, Index v, Index w)
{
    return (positions.row(w) - positions.row(v)).squaredNorm();
}

/// Calls visit(v, w) for each edge of a face.
template <class Visit>
void for_each_edge(std::span<const Index> corners, Visit&& visit)
{
    for (std::size_t k = 0; k < corners.size(); ++k)
        visit(corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
}

/// Sets of vertices that are connected by edges at most ten times as long as the shortest edge at each end.
class Blocks {
  public:
    Blocks(const PolygonMesh& mesh, const Points& positions)
        : mesh_(mesh)
        , positions_(positions)
        , shortest_(mesh.n_vertices(), std::numeric_limits<double>::infinity())
    {
        DisjointSets sets(mesh.n_vertices(), run_serially);
        for (Index f = 0; f < mesh.n_faces(); ++f)
            for_each_edge(mesh.face(f), [&](Index v, Index w) {
                const double squared = squared_length(positions, v, w);
                shortest_[v] = std::min(shortest_[v], squared);
                shortest_[w] = std::min(shortest_[w], squared);
            });
        for (Index f = 0; f < mesh.n_faces(); ++f)
            for_each_edge(mesh.face(f), [&](Index v, Index w) {
                const double bound = least_in_edges * least_in_edges * std::min(shortest_[v], shortest_[w]);
                if (squared_length(positions, v, w) <= bound)
                    sets.join(v, w);
            });
        std::tie(block_of_, n_blocks_) = sets.numbered(run_serially);
        around_.resize(n_blocks_);
        for (const Index block : block_of_)
            ++around_[block].n_vertices;
        for (Index f = 0; f < mesh.n_faces(); ++f)
            measure(mesh.face(f));
    }

    /// The vertices of the blocks that are spikes, ascending.
    [[nodiscard]] std::vector<Spike> spikes() const
    {
        std::vector<Spike> all;
        for (Index v = 0; v < mesh_.n_vertices(); ++v)
            if (const Around& around = around_[block_of_[v]]; around.is_spike())
                all.push_back({v, std::sqrt(around.shortest / around.longest_of_others)});
        return all;
    }

  private:
    /// The surroundings of a block. Lengths are squared.
    struct Around {
        Index n_vertices = 0;
        /// The number of vertices of the largest block beside it.
        Index n_beside = 0;
        /// The shortest edge that leaves the block.
        double shortest = std::numeric_limits<double>::infinity();
        /// The longest edge within another block, of all faces with a corner in this one.
        double longest_of_others = 0.0;
        /// The box around the vertices at the other ends of edges that leave the block.
        Eigen::AlignedBox3d neighbours = {};

        [[nodiscard]] bool is_spike() const
        {
            return longest_of_others > 0.0 && shortest > least_in_edges * least_in_edges * longest_of_others &&
                   shortest > least_in_boxes * least_in_boxes * neighbours.diagonal().squaredNorm() &&
                   (n_vertices == 1 || n_vertices <= most_of_neighbour * n_beside);
        }
    };

    /// Adds the edges of a face to the surroundings of its blocks.
    void measure(std::span<const Index> corners)
    {
        if (std::ranges::all_of(corners, [&](Index v) { return block_of_[v] == block_of_[corners[0]]; }))
            return;
        for_each_edge(corners, [&](Index v, Index w) {
            const double squared = squared_length(positions_, v, w);
            for (const auto& [from, to] : {std::pair(v, w), std::pair(w, v)})
                if (block_of_[from] != block_of_[to])
                    add_leaving(block_of_[from], to, squared);
            for (const Index other : corners)
                if (block_of_[v] == block_of_[w] && block_of_[other] != block_of_[v])
                    around_[block_of_[other]].longest_of_others =
                        std::max(around_[block_of_[other]].longest_of_others, squared);
        });
    }

    /// Adds an edge that leaves a block.
    /// @param to the vertex at its other end.
    void add_leaving(Index block, Index to, double squared)
    {
        Around& around = around_[block];
        around.shortest = std::min(around.shortest, squared);
        around.neighbours.extend(positions_.row(to).transpose());
        around.n_beside = std::max(around.n_beside, around_[block_of_[to]].n_vertices);
    }

    const PolygonMesh& mesh_;
    const Points& positions_;
    /// #V: the squared length of the shortest edge.
    std::vector<double> shortest_;
    /// #V: the block of each vertex.
    std::vector<Index> block_of_;
    Index n_blocks_ = 0;
    std::vector<Around> around_;
};

/// Whether the longest edge of a face is more than ten times as long as the shortest: without such faces, no vertex is
/// a spike.
bool has_needle(std::span<const Index> corners, const Points& positions)
{
    double longest = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const double squared = squared_length(positions, corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
        longest = std::max(longest, squared);
        shortest = std::min(shortest, squared);
    }
    return longest > least_in_edges * least_in_edges * shortest;
}

/// Finds spikes in a mesh that has needles.
std::vector<Spike> spikes_at_needles(const PolygonMesh& mesh, const Points& positions)
{
    return Blocks(mesh, positions).spikes();
}

/// Lengths of the half-edges of a mesh, in units of length.
struct LengthsOfEdges {
    double total = 0.0;
    double longest = 0.0;
    /// The number of half-edges.
    Index n = 0;
    /// Whether a face has edges of very different lengths (see has_needle).
    bool has_needles = false;
};

/// Adds up the lengths of all half-edges. Looks for needles only if no vertices are left out.
/// @param is_left_out #V, or empty: 1 for vertices whose edges do not count.
LengthsOfEdges add_up_edges(const PolygonMesh& mesh, const Points& positions, std::span<const std::uint8_t> is_left_out,
                            const Executor& exec)
{
    const auto add_face = [&](LengthsOfEdges& lengths, Index f) {
        const auto corners = mesh.face(f);
        double around = 0.0;
        double longest = 0.0;
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Index from = corners[k];
            const Index to = corners[k + 1 < corners.size() ? k + 1 : 0];
            if (!is_left_out.empty() && (is_left_out[from] != 0 || is_left_out[to] != 0))
                continue;
            const double length = (positions.row(to) - positions.row(from)).norm();
            around += length;
            longest = std::max(longest, length);
            shortest = std::min(shortest, length);
            ++lengths.n;
        }
        lengths.total += around;
        lengths.longest = std::max(lengths.longest, longest);
        // Only faces whose edges have a larger ratio than this, which are few, are tested for needles, whose ratio
        // exceeds 10.
        constexpr double much = 5.0;
        if (is_left_out.empty() && longest > much * shortest)
            lengths.has_needles = lengths.has_needles || has_needle(corners, positions);
    };
    return reduce(exec, mesh.n_faces(), LengthsOfEdges{}, add_face,
                  [](LengthsOfEdges& all, const LengthsOfEdges& part) {
                      all.total += part.total;
                      all.longest = std::max(all.longest, part.longest);
                      all.n += part.n;
                      all.has_needles = all.has_needles || part.has_needles;
                  });
}

double mean_of(const LengthsOfEdges& edges)
{
    return edges.n > 0 ? edges.total / edges.n : 0.0;
}

/// Whether an edge is so long that edges of spikes, if there are any, change the mean much.
bool has_long_edges(const LengthsOfEdges& edges)
{
    constexpr double long_in_means = 4.0;
    return edges.longest > long_in_means * mean_of(edges);
}

/// The spikes. They are searched for only if there are needles.
/// @param all without vertices left out.
std::vector<Spike> spikes_of(const LengthsOfEdges& all, const PolygonMesh& mesh, const Points& positions)
{
    return all.has_needles ? spikes_at_needles(mesh, positions) : std::vector<Spike>();
}

/// The mean length without the edges of spikes, if these change it much; otherwise that of all half-edges.
double mean_without(const std::vector<Spike>& spikes, const LengthsOfEdges& all, const PolygonMesh& mesh,
                    const Points& positions, const Executor& exec)
{
    if (spikes.empty() || !has_long_edges(all))
        return mean_of(all);
    std::vector<std::uint8_t> is_spike(mesh.n_vertices(), 0);
    for (const Spike& spike : spikes)
        is_spike[spike.vertex] = 1;
    const LengthsOfEdges others = add_up_edges(mesh, positions, is_spike, exec);
    return others.n > 0 ? mean_of(others) : mean_of(all);
}

}  // namespace

double mean_edge_length(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const LengthsOfEdges all = add_up_edges(mesh, positions, {}, exec);
    return has_long_edges(all) ? mean_without(spikes_of(all, mesh, positions), all, mesh, positions, exec)
                               : mean_of(all);
}

EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const LengthsOfEdges all = add_up_edges(mesh, positions, {}, exec);
    EdgeMeasures measures;
    measures.spikes = spikes_of(all, mesh, positions);
    measures.mean = mean_without(measures.spikes, all, mesh, positions, exec);
    return measures;
}

std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const std::vector<Index> needles =
        select(exec, mesh.n_faces(), [&](Index f) { return has_needle(mesh.face(f), positions); });
    return needles.empty() ? std::vector<Spike>() : spikes_at_needles(mesh, positions);
}

Points without_spikes(const PolygonMesh& mesh, const Topology& topology, const std::vector<Spike>& spikes,
                      const Points& positions)
{
    Points filled = positions;
    std::vector<Index> left;
    for (const Spike& spike : spikes)
        left.push_back(spike.vertex);
    while (!left.empty()) {
        // All means of a round are taken before vertices move, so that their order does not matter.
        std::vector<Index> next;
        Points means(static_cast<Eigen::Index>(left.size()), 3);
        std::vector<Index> done;
        for (const Index v : left) {
            std::vector<Index> around = neighbours_of(mesh, topology, v);
            std::erase_if(around, [&](Index w) { return std::ranges::binary_search(left, w); });
            if (around.empty()) {
                next.push_back(v);
                continue;
            }
            means.row(std::ssize(done)) = filled(around, Eigen::all).colwise().mean();
            done.push_back(v);
        }
        if (done.empty())
            break;
        for (std::size_t i = 0; i < done.size(); ++i)
            filled.row(done[i]) = means.row(static_cast<Eigen::Index>(i));
        left = std::move(next);
    }
    return filled;
}

Remark remark_on_spikes(const std::vector<Spike>& spikes)
{
    const Spike& farthest = *std::ranges::max_element(spikes, {}, &Spike::distance);
    const bool is_one = spikes.size() == 1;
    const std::string who =
        is_one ? fmt::format("Vertex {} (numbered from 0) is", farthest.vertex)
               : fmt::format("{} vertices are spikes: vertex {} (numbered from 0) is", spikes.size(), farthest.vertex);
    return {"spikes",
            {{"vertices", spikes.size()}, {"farthest", farthest.vertex}, {"edges away", farthest.distance}},
            {fmt::format("{} {:.0f} edges away from its neighbours; remove {}, or give {} the right position.", who,
                         farthest.distance, is_one ? "it" : "them", is_one ? "it" : "them")}};
}

}  // namespace seamflow
