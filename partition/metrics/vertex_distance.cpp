#include "partition/metrics/vertex_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

struct LengthsOfEdges {
    double total = 0.0;
    double longest = 0.0;
    Index n = 0;
    /// See needle_tip.
    std::vector<Index> tips = {};
};

/// @param is_left_out #V, or empty: vertices whose edges do not count.
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
        // Few faces have edges that differ so much.
        constexpr double much = 5.0;
        if (is_left_out.empty() && longest > much * shortest)
            if (const Index tip = needle_tip(corners, positions); tip >= 0)
                lengths.tips.push_back(tip);
    };
    return reduce(exec, mesh.n_faces(), LengthsOfEdges{}, add_face,
                  [](LengthsOfEdges& all, const LengthsOfEdges& part) {
                      all.total += part.total;
                      all.longest = std::max(all.longest, part.longest);
                      all.n += part.n;
                      all.tips.insert(all.tips.end(), part.tips.begin(), part.tips.end());
                  });
}

double mean_of(const LengthsOfEdges& edges)
{
    return edges.n > 0 ? edges.total / edges.n : 0.0;
}

/// Whether spikes would count much in the mean.
bool has_long_edges(const LengthsOfEdges& edges)
{
    constexpr double long_in_means = 4.0;
    return edges.longest > long_in_means * mean_of(edges);
}

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

double mean_edge_length(const PolygonMesh& mesh)
{
    return mean_edge_length(mesh, mesh.vertices);
}

double mean_edge_length(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const LengthsOfEdges all = add_up_edges(mesh, positions, {}, exec);
    return has_long_edges(all) ? mean_without(spikes_among(mesh, positions, all.tips), all, mesh, positions, exec)
                               : mean_of(all);
}

EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec)
{
    const LengthsOfEdges all = add_up_edges(mesh, positions, {}, exec);
    EdgeMeasures measures;
    measures.spikes = spikes_among(mesh, positions, all.tips);
    measures.mean = mean_without(measures.spikes, all, mesh, positions, exec);
    return measures;
}

VertexDistance vertex_distance(const PolygonMesh& mesh, const Points& reference, const Points& candidate)
{
    if (reference.rows() != candidate.rows())
        throw InputError(fmt::format("the reference has {} vertices, the candidate {}: only meshes with corresponding "
                                     "vertices can be compared",
                                     reference.rows(), candidate.rows()));
    if (reference.rows() != mesh.vertices.rows())
        throw InputError(fmt::format("there are {} positions, but the mesh has {} vertices", reference.rows(),
                                     mesh.vertices.rows()));
    VertexDistance distance;
    distance.mean_edge = mean_edge_length(mesh, reference);
    if (reference.rows() == 0)
        return distance;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    const std::vector<std::uint8_t> is_used = used_by_faces(mesh);
    Index n_used = 0;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (is_used[v] == 0 && mesh.n_faces() > 0)
            continue;
        ++n_used;
        const double squared = (candidate.row(v) - reference.row(v)).squaredNorm();
        sum += std::sqrt(squared);
        sum_of_squares += squared;
        distance.max = std::max(distance.max, std::sqrt(squared));
    }
    const auto count = static_cast<double>(n_used);
    distance.mean = sum / count;
    distance.rms = std::sqrt(sum_of_squares / count);
    return distance;
}

}  // namespace seamflow
