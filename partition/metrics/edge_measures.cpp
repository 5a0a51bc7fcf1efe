#include "partition/metrics/edge_measures.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "partition/metrics/vertex_distance.h"

namespace seamflow {

namespace {

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
    std::vector<std::uint8_t> is_spike(usize(mesh.n_vertices()), 0);
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

}  // namespace seamflow
