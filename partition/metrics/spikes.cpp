#include "partition/metrics/spikes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

constexpr double least_in_edges = 10.0;
constexpr double least_in_boxes = 3.0;

double squared_length(const Points& positions, Index v, Index w)
{
    return (positions.row(w) - positions.row(v)).squaredNorm();
}

/// Squares of lengths around a vertex.
struct Around {
    Index vertex = 0;
    double shortest = std::numeric_limits<double>::infinity();
    double longest_of_others = 0.0;
    Eigen::AlignedBox3d neighbours = {};

    void add(std::span<const Index> corners, const Points& positions)
    {
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Index from = corners[k];
            const Index to = corners[k + 1 < corners.size() ? k + 1 : 0];
            const double squared = squared_length(positions, from, to);
            if (from != vertex && to != vertex) {
                longest_of_others = std::max(longest_of_others, squared);
                continue;
            }
            shortest = std::min(shortest, squared);
            neighbours.extend(positions.row(from == vertex ? to : from).transpose());
        }
    }

    [[nodiscard]] bool is_spike() const
    {
        return longest_of_others > 0.0 && shortest > least_in_edges * least_in_edges * longest_of_others &&
               shortest > least_in_boxes * least_in_boxes * neighbours.diagonal().squaredNorm();
    }
};

}  // namespace

Index needle_tip(std::span<const Index> corners, const Points& positions)
{
    // The shortest edge of such a face is not at the tip, and the longest one is.
    double longest = -1.0;
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t at_longest = 0;
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const double squared = squared_length(positions, corners[k], corners[k + 1 < n ? k + 1 : 0]);
        shortest = std::min(shortest, squared);
        if (squared > longest) {
            longest = squared;
            at_longest = k;
        }
    }
    if (!(longest > least_in_edges * least_in_edges * shortest))
        return -1;
    for (const std::size_t tip : {at_longest, (at_longest + 1) % n}) {
        Around around{.vertex = corners[tip]};
        around.add(corners, positions);
        if (around.shortest > least_in_edges * least_in_edges * around.longest_of_others)
            return corners[tip];
    }
    return -1;
}

std::vector<Spike> find_spikes(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    using Tips = std::vector<Index>;
    Tips tips = reduce(
        exec, mesh.n_faces(), Tips(),
        [&](Tips& found, Index f) {
            if (const Index tip = needle_tip(mesh.face(f), positions); tip >= 0)
                found.push_back(tip);
        },
        [](Tips& all, const Tips& part) { all.insert(all.end(), part.begin(), part.end()); });
    return spikes_among(mesh, positions, std::move(tips));
}

std::vector<Spike> spikes_among(const PolygonMesh& mesh, const Points& positions, std::vector<Index> tips)
{
    if (tips.empty())
        return {};
    sort_unique(tips);
    std::vector<Around> around(tips.size());
    for (std::size_t i = 0; i < tips.size(); ++i)
        around[i].vertex = tips[i];
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f))
            if (const Index place = position_in(tips, v); place >= 0)
                around[place].add(mesh.face(f), positions);
    std::vector<Spike> spikes;
    for (const Around& one : around)
        if (one.is_spike())
            spikes.push_back({one.vertex, std::sqrt(one.shortest / one.longest_of_others)});
    return spikes;
}

std::string remark_on_spikes(const std::vector<Spike>& spikes)
{
    const Spike& farthest = *std::ranges::max_element(spikes, {}, &Spike::distance);
    const bool is_one = spikes.size() == 1;
    const std::string who =
        is_one ? fmt::format("Vertex {} (numbered from 0) is", farthest.vertex)
               : fmt::format("{} vertices are spikes: vertex {} (numbered from 0) is", spikes.size(), farthest.vertex);
    return fmt::format("{} {:.0f} edges away from its neighbours; remove {}, or give {} the right position.", who,
                       farthest.distance, is_one ? "it" : "them", is_one ? "it" : "them");
}

}  // namespace seamflow
