#include "partition/metrics/edge_fans.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "partition/metrics/box_tree.h"

namespace seamflow {

namespace {

/// Edges whose ends both have many triangles, with one of their triangles each, sorted.
std::vector<std::pair<Edge, Index>> busy_edges(std::span<const Triangle> triangles, Index n_vertices)
{
    std::vector<Index> n_triangles(at(n_vertices), 0);
    for (const Triangle& t : triangles)
        for (const Index v : t)
            ++n_triangles[v];
    std::vector<std::pair<Edge, Index>> edges;
    const auto is_busy = [&](Index v) { return n_triangles[v] >= fewest_of_edge_fan; };
    for (Index i = 0; i < std::ssize(triangles); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto [a, b] = std::minmax({triangles[i][k], triangles[i][(k + 1) % 3]}); is_busy(a) && is_busy(b))
                edges.push_back({{a, b}, i});
    std::ranges::sort(edges);
    return edges;
}

/// The direction from an edge to a point, upright on the edge, as a box around it that no rounding leaves.
Box direction_from(const std::array<Point, 2>& edge, const Point& point)
{
    constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
    const Point axis = Point(edge[1] - edge[0]).stableNormalized();
    const Point offset = point - edge[0];
    const Point upright = offset - offset.dot(axis) * axis;
    const double length = upright.stableNorm();
    const double error = rounding * (1.0 + offset.stableNorm() / length);
    // Also if it is not a number.
    if (!(error < 1.0))
        return {Point::Constant(-1.0), Point::Constant(1.0)};
    const Point direction = upright / length;
    return {direction - Point::Constant(error), direction + Point::Constant(error)};
}

}  // namespace

std::vector<EdgeFan> edge_fans_of(std::span<const Triangle> triangles, Index n_vertices)
{
    std::vector<EdgeFan> fans;
    const auto edges = busy_edges(triangles, n_vertices);
    std::vector<bool> is_in_fan(edges.empty() ? 0 : triangles.size());
    for (auto begin = edges.begin(); begin != edges.end();) {
        const auto end =
            std::find_if(begin, edges.end(), [&](const auto& entry) { return entry.first != begin->first; });
        EdgeFan fan{begin->first, {}};
        for (auto entry = begin; entry != end; ++entry)
            if (!is_in_fan[entry->second])
                fan.triangles.push_back(entry->second);
        if (std::ssize(fan.triangles) >= fewest_of_edge_fan) {
            for (const Index i : fan.triangles)
                is_in_fan[i] = true;
            fans.push_back(std::move(fan));
        }
        begin = end;
    }
    return fans;
}

void for_each_pair_in_one_plane(const std::array<Point, 2>& edge, std::span<const Point> third,
                                const std::function<bool(Index i, Index j)>& visit)
{
    const auto n = static_cast<Index>(third.size());
    const Box whole{Point::Constant(-1.0), Point::Constant(1.0)};
    std::vector<std::pair<std::uint64_t, Index>> order;
    for (Index i = 0; i < n; ++i)
        order.emplace_back(place_on_curve(direction_from(edge, third[i]), whole), i);
    std::ranges::sort(order);
    std::vector<Box> directions;
    for (const auto& [place, i] : order)
        directions.push_back(direction_from(edge, third[i]));
    const BoxTree tree(std::move(directions));
    bool goes_on = true;
    for (Index i = 0; i < n && goes_on; ++i)
        tree.for_each_meeting(tree.leaf(i), i + 1,
                              [&](Index j) { goes_on = goes_on && visit(order[i].second, order[j].second); });
}

}  // namespace seamflow
