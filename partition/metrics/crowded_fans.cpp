#include "partition/metrics/crowded_fans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "partition/metrics/box_tree.h"

namespace seamflow {

namespace {

/// Edges, or single vertices written as an edge from the vertex to itself, each with one of its triangles.
using Crowd = std::vector<std::pair<Edge, Index>>;

/// Makes fans of the triangles of a crowd that are in no fan yet, where they are enough for a crowded fan.
void add_fans(Crowd crowd, std::vector<bool>& is_in_fan, std::vector<CrowdedFan>& fans)
{
    std::ranges::sort(crowd);
    for (auto begin = crowd.begin(); begin != crowd.end();) {
        const auto end =
            std::find_if(begin, crowd.end(), [&](const auto& entry) { return entry.first != begin->first; });
        CrowdedFan fan{begin->first, {}};
        for (auto entry = begin; entry != end; ++entry)
            if (!is_in_fan[entry->second])
                fan.triangles.push_back(entry->second);
        if (std::ssize(fan.triangles) >= fewest_of_crowded_fan) {
            for (const Index i : fan.triangles)
                is_in_fan[i] = true;
            fans.push_back(std::move(fan));
        }
        begin = end;
    }
}

/// A bound of the rounding error of a unit vector.
constexpr double direction_rounding = 32.0 * std::numeric_limits<double>::epsilon();

/// A box that contains every unit vector: nothing is known about the direction.
Box all_directions()
{
    return {Point::Constant(-1.0), Point::Constant(1.0)};
}

/// The directions from an edge to a point, perpendicular to the edge, as a box that contains all of them despite
/// rounding.
Box direction_from(const std::array<Point, 2>& edge, const Point& point)
{
    const Point axis = Point(edge[1] - edge[0]).stableNormalized();
    const Point offset = point - edge[0];
    const Point upright = offset - offset.dot(axis) * axis;
    const double length = upright.stableNorm();
    const double error = direction_rounding * (1.0 + offset.stableNorm() / length);
    // The condition is also true if the error is not a number.
    if (!(error < 1.0))
        return all_directions();
    const Point direction = upright / length;
    return {direction - Point::Constant(error), direction + Point::Constant(error)};
}

/// The directions from a vertex to the points of an edge, as a box around their arc on the unit sphere.
Box directions_from(const Point& vertex, const std::array<Point, 2>& edge)
{
    const Point one = Point(edge[0] - vertex).stableNormalized();
    const Point other = Point(edge[1] - vertex).stableNormalized();
    // The height of the arc above its chord: 1 - cos(angle / 2), where half the chord is sin(angle / 2).
    const double bulge = 1.0 - std::sqrt(std::max(0.0, 1.0 - 0.25 * (one - other).squaredNorm())) + direction_rounding;
    const bool have_length = one.squaredNorm() > 0.5 && other.squaredNorm() > 0.5;
    // The condition is also true if the bulge is NaN.
    if (!have_length || !(bulge < 1.0))
        return all_directions();
    return {one.cwiseMin(other) - Point::Constant(bulge), one.cwiseMax(other) + Point::Constant(bulge)};
}

/// The third corner of a triangle at an edge, or the two other corners of a triangle at a vertex.
std::array<Index, 2> others_of(const Triangle& triangle, const Edge& edge)
{
    std::array<Index, 2> others{};
    std::size_t n = 0;
    for (const Index v : triangle)
        if (v != edge[0] && v != edge[1] && n < 2)
            others[n++] = v;
    return {others[0], others[n < 2 ? 0 : 1]};
}

}  // namespace

std::vector<CrowdedFan> crowded_fans_of(std::span<const Triangle> triangles, Index n_vertices)
{
    std::vector<Index> n_triangles(usize(n_vertices), 0);
    for (const Triangle& t : triangles)
        for (const Index v : t)
            ++n_triangles[v];
    Crowd edges;
    Crowd vertices;
    const auto is_crowded = [&](Index v) { return n_triangles[v] >= fewest_of_crowded_fan; };
    for (Index i = 0; i < std::ssize(triangles); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax({triangles[i][k], triangles[i][(k + 1) % 3]});
            if (is_crowded(a) && is_crowded(b))
                edges.push_back({{a, b}, i});
            if (is_crowded(triangles[i][k]))
                vertices.push_back({{triangles[i][k], triangles[i][k]}, i});
        }
    std::vector<CrowdedFan> fans;
    std::vector<bool> is_in_fan(vertices.empty() ? 0 : triangles.size());
    add_fans(std::move(edges), is_in_fan, fans);
    add_fans(std::move(vertices), is_in_fan, fans);
    return fans;
}

void for_each_pair_in_one_direction(const CrowdedFan& fan, std::span<const Triangle> corners, const Points& positions,
                                    const std::function<bool(Index i, Index j)>& visit)
{
    const std::array<Point, 2> edge{positions.row(fan.edge[0]), positions.row(fan.edge[1])};
    std::vector<Box> directions;
    std::vector<Point> middles;
    for (const Triangle& triangle : corners) {
        const auto [one, other] = others_of(triangle, fan.edge);
        directions.push_back(fan.edge[0] == fan.edge[1]
                                 ? directions_from(edge[0], {positions.row(one), positions.row(other)})
                                 : direction_from(edge, positions.row(one)));
        middles.push_back(centre_of(directions.back()));
    }
    const std::vector<Index> order = order_of_neighbours(middles);
    std::vector<Box> leaves;
    for (const Index i : order)
        leaves.push_back(directions[i]);
    const BoxTree tree(std::move(leaves));
    bool goes_on = true;
    for (Index i = 0; i < tree.size() && goes_on; ++i)
        tree.for_each_meeting(tree.leaf(i), i + 1, [&](Index j) { goes_on = goes_on && visit(order[i], order[j]); });
}

}  // namespace seamflow
