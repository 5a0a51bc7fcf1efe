#include "partition/metrics/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "partition/errors.h"
#include "partition/metrics/box_tree.h"
#include "partition/metrics/triangulation.h"

namespace seamflow {

namespace {

/// Stands for no point: infinitely far away.
const Point nowhere = Point::Constant(std::numeric_limits<double>::infinity());

/// The point of the plane of the triangle that is nearest to the origin; `nowhere` if it lies outside the triangle.
Point foot_inside(const Point& a, const Point& b, const Point& c)
{
    const Point u = b - a;
    const Point w = c - a;
    const double uu = u.squaredNorm();
    const Point height = w - (w.dot(u) / uu) * u;
    const double hh = height.squaredNorm();
    double s = 0.0;
    double t = 0.0;
    Point foot = a;
    // Further passes correct the effect of the rounding of `height` on the first one in a thin triangle.
    for (int pass = 0; pass < 3; ++pass) {
        const double dt = -foot.dot(height) / hh;
        s -= (foot + dt * w).dot(u) / uu;
        t += dt;
        foot = a + s * u + t * w;
    }
    // The comparison is false for a triangle without area, whose numbers are NaN.
    const bool inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
    return inside ? foot : nowhere;
}

/// A point and its squared distance from the origin.
struct Foot {
    Point point;
    double squared;

    void use_if_closer(const Point& other)
    {
        if (const double s = other.squaredNorm(); s < squared) {
            point = other;
            squared = s;
        }
    }

    /// Uses the nearest point of the segment between a and b, which may be one point, if it is closer.
    void use_if_closer(const Point& a, const Point& b)
    {
        const Point u = b - a;
        const double uu = u.squaredNorm();
        use_if_closer(b);
        use_if_closer(uu > 0.0 ? Point(a + std::clamp(-a.dot(u) / uu, 0.0, 1.0) * u) : a);
    }
};

/// The point of a triangle that is closest to the origin.
Foot foot_on(const TriangleCorners& t)
{
    Foot foot{nowhere, std::numeric_limits<double>::infinity()};
    foot.use_if_closer(t[0], t[1]);
    foot.use_if_closer(t[1], t[2]);
    foot.use_if_closer(t[2], t[0]);
    foot.use_if_closer(foot_inside(t[0], t[1], t[2]));
    return foot;
}

}  // namespace

double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c)
{
    return foot_on({a, b, c}).squared;
}

namespace {

/// The number of examined triangles and nodes above which the search for one point counts as slow.
constexpr std::size_t few_candidates = 256;

Box box_of(const TriangleCorners& t)
{
    Box box;
    for (const Point& p : t)
        box.add(p);
    return box;
}

/// The triangles in an order that keeps neighbours together.
/// @throws InputError for a mesh without faces.
std::vector<TriangleCorners> triangles_of(const PolygonMesh& surface, const Executor& exec)
{
    if (surface.n_faces() == 0)
        throw InputError("there are no faces, and so no surface to measure distances from");
    const std::vector<Triangle> triangles = triangulate(surface);
    const auto corners = [&](Index i) -> TriangleCorners {
        const auto& [a, b, c] = triangles[i];
        return {surface.vertices.row(a), surface.vertices.row(b), surface.vertices.row(c)};
    };
    const auto n = static_cast<Index>(triangles.size());
    std::vector<Point> centres(triangles.size());
    for_each(exec, n, [&](Index i) { centres[i] = centre_of(box_of(corners(i))); });
    const std::vector<Index> order = order_of_neighbours(centres, exec);
    std::vector<TriangleCorners> sorted(triangles.size());
    for_each(exec, n, [&](Index i) { sorted[i] = corners(order[i]); });
    return sorted;
}

std::vector<Box> boxes_of(const std::vector<TriangleCorners>& triangles)
{
    std::vector<Box> boxes(triangles.size());
    std::ranges::transform(triangles, boxes.begin(), box_of);
    return boxes;
}

TriangleCorners relative_to(const Point& origin, const TriangleCorners& t)
{
    return {t[0] - origin, t[1] - origin, t[2] - origin};
}

/// Whether the plane of a triangle is certainly further from the origin than a bound, which is squared.
bool is_plane_beyond(const TriangleCorners& t, double squared_bound)
{
    // Rounding tilts the planes of thinner triangles, and those of tiny ones.
    constexpr double least_squared_sine = 1e-6;
    constexpr double underflow = 1e-250;
    constexpr double plane_rounding = 1e-11;
    const Point u = t[1] - t[0];
    const Point w = t[2] - t[0];
    const Point normal = u.cross(w);
    const double squared = normal.squaredNorm();
    const double height = normal.dot(t[0]);
    return squared > least_squared_sine * u.squaredNorm() * w.squaredNorm() + underflow &&
           height * height > (squared_bound + plane_rounding * t[0].squaredNorm()) * squared;
}

}  // namespace

class SurfaceDistance::Tree {
  public:
    Tree(const PolygonMesh& surface, const Executor& exec)
        : triangles_(triangles_of(surface, exec))
        , tree_(boxes_of(triangles_))
    {
    }

    /// The distance of each point from the surface.
    [[nodiscard]] std::vector<double> distances(std::span<const Point> points, const Executor& exec) const
    {
        const std::vector<Index> order = order_of_neighbours(points, exec);
        std::vector<double> distances(points.size());
        const Candidates all{{}, {{0.0, tree_.root()}}};
        for_each_block(exec, static_cast<Index>(points.size()), [&](Index, Index begin, Index end) {
            Index closest = 0;
            measure(points, std::span(order).subspan(begin, end - begin), all, closest, distances);
        });
        return distances;
    }

  private:
    /// Points within a radius around a centre.
    struct Group {
        Point centre = Point::Zero();
        double radius = 0.0;
        /// The point of the surface that is closest to the centre, relative to it, and its distance.
        Point foot = Point::Zero();
        double distance = 0.0;

        /// The largest distance from the centre at which a triangle can be the closest for a point of the group: no
        /// point is further from the surface than the sum of distance and radius.
        [[nodiscard]] double reach() const { return distance + 2.0 * radius; }

        /// The same for triangles in a plane with this unit normal, which points from the centre to the plane. Seen
        /// from the point at p from the centre, the foot is at most distance - p·foot/distance + p²/(2 distance) away,
        /// and the plane nearer by p·direction than from the centre.
        [[nodiscard]] double reach(const Point& direction) const
        {
            const double bound =
                distance + radius * (direction - foot / distance).norm() + radius * radius / (2.0 * distance);
            // The bound is NaN if the centre is on the surface; then the other reach is used.
            return bound < reach() ? bound : reach();
        }
    };

    /// A node of the tree, and a lower bound of its distance from the centre of a group.
    struct Candidate {
        double distance;
        BoxTree::Node node;
    };

    /// The nodes that may contain the closest points of all points of a group.
    struct Candidates {
        Group group;
        std::vector<Candidate> nodes;
    };

    /// The result of the search for one point.
    struct Answer {
        double distance;
        /// The number of candidates that were examined.
        std::size_t n_examined;
    };

    Answer distance(const Point& p, const Candidates& candidates, Index& closest) const;
    void add_within_reach(BoxTree::Node node, Candidates& found) const;
    Candidates narrowed(std::span<const Point> points, std::span<const Index> group, const Candidates& candidates,
                        Index& closest) const;
    void measure(std::span<const Point> points, std::span<const Index> group, const Candidates& candidates,
                 Index& closest, std::vector<double>& distances) const;

    std::vector<TriangleCorners> triangles_;
    BoxTree tree_;
};

/// The distance of point p from the surface.
/// @param candidates to search. @param closest in: the triangle to begin with; out: the closest triangle.
SurfaceDistance::Tree::Answer SurfaceDistance::Tree::distance(const Point& p, const Candidates& candidates,
                                                              Index& closest) const
{
    const double offset = (p - candidates.group.centre).norm();
    double squared = foot_on(relative_to(p, triangles_[closest])).squared;
    // The distance from the centre of the group beyond which a node is farther from p than the closest triangle so far.
    double reach = std::sqrt(squared) + offset;
    std::size_t n_examined = candidates.nodes.size();
    const auto examine = [&](Index i) {
        ++n_examined;
        const TriangleCorners triangle = relative_to(p, triangles_[i]);
        if (is_plane_beyond(triangle, squared))
            return;
        if (const double s = foot_on(triangle).squared; s < squared) {
            squared = s;
            reach = std::sqrt(s) + offset;
            closest = i;
        }
    };
    for (const Candidate& candidate : candidates.nodes)
        if (candidate.distance <= reach)
            tree_.for_each_nearer(p, candidate.node, squared, examine);
    return {std::sqrt(squared), n_examined};
}

/// Adds the nodes below `node` within reach of the group that are triangles or no larger than the group.
void SurfaceDistance::Tree::add_within_reach(BoxTree::Node node, Candidates& found) const
{
    const Group& group = found.group;
    const double reach = group.reach();
    const Box& box = tree_.box(node);
    double squared = squared_distance(box, group.centre);
    if (squared > reach * reach)
        return;
    if (node.level > 0 && (box.high - box.low).norm() > 2.0 * group.radius) {
        tree_.for_each_child(node, [&](BoxTree::Node child) { add_within_reach(child, found); });
        return;
    }
    if (node.level == 0) {
        const TriangleCorners triangle = relative_to(group.centre, triangles_[node.number]);
        const Point normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
        const double bound = group.reach(normal.dot(triangle[0]) < 0.0 ? Point(-normal) : normal);
        if (is_plane_beyond(triangle, bound * bound))
            return;
        squared = foot_on(triangle).squared;
    }
    if (squared <= reach * reach)
        found.nodes.push_back({std::sqrt(squared), node});
}

/// The candidates of a group of points, found among the nodes below the candidates of a larger group.
/// @param closest in: the triangle to begin with; out: the triangle closest to the centre of the group.
SurfaceDistance::Tree::Candidates SurfaceDistance::Tree::narrowed(std::span<const Point> points,
                                                                  std::span<const Index> group,
                                                                  const Candidates& candidates, Index& closest) const
{
    Box box;
    for (const Index v : group)
        box.add(points[v]);
    Candidates found;
    found.group.centre = centre_of(box);
    for (const Index v : group)
        found.group.radius = std::max(found.group.radius, (points[v] - found.group.centre).norm());
    found.group.distance = distance(found.group.centre, candidates, closest).distance;
    found.group.foot = foot_on(relative_to(found.group.centre, triangles_[closest])).point;
    // The distances of the candidates are from the centre of the larger group.
    const double reach = found.group.reach() + (found.group.centre - candidates.group.centre).norm();
    for (const Candidate& candidate : candidates.nodes)
        if (candidate.distance <= reach)
            add_within_reach(candidate.node, found);
    return found;
}

/// Measures point by point, each search beginning with the closest triangle of the previous point, as long as this is
/// fast. If it is slow, because many triangles are about as far away, the rest of the group is divided into halves, and
/// the nodes within reach of each half are found first.
void SurfaceDistance::Tree::measure(std::span<const Point> points, std::span<const Index> group,
                                    const Candidates& candidates, Index& closest, std::vector<double>& distances) const
{
    for (std::size_t k = 0; k < group.size(); ++k) {
        const Answer answer = distance(points[group[k]], candidates, closest);
        distances[group[k]] = answer.distance;
        if (answer.n_examined <= few_candidates)
            continue;
        const auto rest = group.subspan(k + 1);
        for (const auto half : {rest.first(rest.size() / 2), rest.subspan(rest.size() / 2)})
            if (!half.empty())
                measure(points, half, narrowed(points, half, candidates, closest), closest, distances);
        return;
    }
}

SurfaceDistance::SurfaceDistance(const PolygonMesh& surface, const Executor& exec)
    : tree_(std::make_unique<const Tree>(surface, exec))
{
}

SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

std::vector<double> SurfaceDistance::operator()(const Points& points, const Executor& exec) const
{
    std::vector<Point> rows;
    rows.reserve(static_cast<std::size_t>(points.rows()));
    for (const auto& row : points.rowwise())
        rows.emplace_back(row);
    return tree_->distances(rows, exec);
}

LengthStatistics surface_distance(const PolygonMesh& from, const PolygonMesh& to, const Executor& exec)
{
    if (from.n_faces() == 0)
        throw InputError("there are no faces, and so no vertices of a surface to measure distances of");
    std::vector<double> distances = SurfaceDistance(to, exec)(from.vertices, exec);
    const std::vector<std::uint8_t> is_used = used_by_faces(from);
    for (std::size_t v = 0; v < distances.size(); ++v)
        if (is_used[v] == 0)
            distances[v] = std::numeric_limits<double>::quiet_NaN();
    return length_statistics(distances);
}

LengthStatistics larger_of(const LengthStatistics& a, const LengthStatistics& b)
{
    return {.mean = std::max(a.mean, b.mean), .rms = std::max(a.rms, b.rms), .max = std::max(a.max, b.max)};
}

}  // namespace seamflow
