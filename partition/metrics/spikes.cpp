#include "partition/metrics/spikes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "partition/disjoint_sets.h"

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
        , shortest_(usize(mesh.n_vertices()), std::numeric_limits<double>::infinity())
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
        around_.resize(usize(n_blocks_));
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

}  // namespace

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

std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const std::vector<Index> needles =
        select(exec, mesh.n_faces(), [&](Index f) { return has_needle(mesh.face(f), positions); });
    return needles.empty() ? std::vector<Spike>() : spikes_at_needles(mesh, positions);
}

std::vector<Spike> spikes_at_needles(const PolygonMesh& mesh, const Points& positions)
{
    return Blocks(mesh, positions).spikes();
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
