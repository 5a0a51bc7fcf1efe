#include "solvers/denoising/rim_filter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "partition/vector_area.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// Shorter rims have no noise that could be told.
constexpr std::size_t fewest_segments = 24;
/// Rounds of means of directions, without and with regard to how much these differ, and the difference: a chord.
constexpr int plain_rounds = 2;
constexpr int bilateral_rounds = 10;
constexpr double alike = 0.4;
/// Of moving vertices to fit directions.
constexpr int fitting_rounds = 40;
constexpr double momentum = 0.5;
/// As for surfaces (see NoisyPlaces): the median of motions, in edge lengths, and the correlation of neighbours.
constexpr double least_rim_median = 0.009;
constexpr double most_rim_correlation = 0.28;

}  // namespace

RimFilter::RimFilter(const PolygonMesh& mesh, const Topology& topology)
{
    const auto is_rim = [&](Index v) { return topology.kind[v] == VertexKind::Boundary; };
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_rim(v))
            vertices_.push_back(v);
    if (vertices_.empty())
        return;
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const Index from = mesh.face_vertices[h];
        const Index to = mesh.face_vertices[topology.next(mesh, h)];
        if (topology.twin[h] < 0 && is_rim(from) && is_rim(to))
            segments_.push_back({{place_in(vertices_, from), place_in(vertices_, to)}, topology.face_of[h]});
    }
    const auto n = static_cast<Index>(segments_.size());
    // Segment and end, 2 s + end, at each vertex.
    const IndexLists at_vertex = make_lists(static_cast<Index>(vertices_.size()), [&](auto&& enter) {
        for (Index s = 0; s < n; ++s)
            for (Index end : {0, 1})
                enter(segments_[s].ends[usize(end)], 2 * s + end);
    });
    for (Index s = 0; s < n; ++s)
        for (Index end : {0, 1}) {
            const auto around = at_vertex[segments_[s].ends[usize(end)]];
            if (around.size() != 2)
                continue;
            const Index other = around[0] == 2 * s + end ? around[1] : around[0];
            segments_[s].neighbours[usize(end)] = other / 2;
            segments_[s].signs[usize(end)] = other % 2 == end ? -1.0 : 1.0;
        }
    rims_ = connected_components(n, [&](Index s, auto&& visit) {
        for (const Index other : segments_[s].neighbours)
            if (other >= 0)
                visit(other);
    });
}

Points RimFilter::smooth_normals(const Points& normals, const Points& positions) const
{
    const auto n = static_cast<Index>(segments_.size());
    Points directions(n, 3);
    std::vector<double> lengths(usize(n));
    for (Index s = 0; s < n; ++s) {
        const Point way = positions.row(segments_[s].ends[1]) - positions.row(segments_[s].ends[0]);
        lengths[s] = way.norm();
        directions.row(s) = unit_or_zero(way);
    }
    for (int round = 0; round < plain_rounds + bilateral_rounds; ++round) {
        const Points before = directions;
        for (Index s = 0; s < n; ++s) {
            Point total = lengths[s] * before.row(s);
            for (std::size_t end = 0; end < 2; ++end) {
                const Index other = segments_[s].neighbours[end];
                if (other < 0)
                    continue;
                const Point direction = segments_[s].signs[end] * before.row(other);
                const double chord = (direction - before.row(s)).norm() / alike;
                total += (round < plain_rounds ? 1.0 : std::exp(-0.5 * chord * chord)) * lengths[other] * direction;
            }
            directions.row(s) = unit_or_zero(total);
        }
    }
    for (Index s = 0; s < n; ++s)
        directions.row(s) = unit_or_zero(directions.row(s).cross(normals.row(segments_[s].face)));
    return directions;
}

bool RimFilter::is_noisy(std::span<const Index> rim, const Points& across, const Points& before,
                         const Points& after) const
{
    if (rim.size() < fewest_segments)
        return false;
    std::vector<double> lengths;
    double products = 0.0;
    double squares = 0.0;
    for (const Index s : rim) {
        const auto [from, to] = segments_[s].ends;
        const double here = (after.row(from) - before.row(from)).dot(across.row(s));
        const double there = (after.row(to) - before.row(to)).dot(across.row(s));
        const double length = (before.row(to) - before.row(from)).norm();
        lengths.push_back(length > 0.0 ? std::abs(here) / length : 0.0);
        products += here * there;
        squares += 0.5 * (here * here + there * there);
    }
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::ranges::nth_element(lengths, middle);
    return *middle > least_rim_median && products < most_rim_correlation * squares;
}

void RimFilter::apply(const Topology& topology, const Points& normals, const std::vector<double>& parts,
                      Points& positions) const
{
    if (segments_.empty())
        return;
    const Points before = positions(vertices_, Eigen::all);
    const Points across = smooth_normals(normals, before);
    Points last = before;
    Points now = before;
    for (int round = 0; round < fitting_rounds; ++round) {
        Points next = now + momentum * (now - last);
        for (Index s = 0; s < across.rows(); ++s) {
            const Point normal = across.row(s);
            const auto [from, to] = segments_[s].ends;
            // Half of the way to the line through the middle, from either end; each vertex has two segments.
            const double half = 0.25 * normal.dot(now.row(to) - now.row(from));
            next.row(from) += half * normal;
            next.row(to) -= half * normal;
        }
        last.swap(now);
        now.swap(next);
    }
    for (Index r = 0; r < rims_.count(); ++r)
        if (is_noisy(rims_.nodes[r], across, before, now))
            for (const Index s : rims_.nodes[r])
                for (const Index place : segments_[s].ends)
                    if (const Index v = vertices_[place]; topology.moves(v))
                        positions.row(v) = before.row(place) + parts[v] * (now.row(place) - before.row(place));
}

}  // namespace seamflow
