#include "partition/metrics/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "partition/errors.h"
#include "partition/metrics/triangulation.h"

namespace seamflow {

namespace {

// No predicate or construction of the kernel determines a distance: it only holds the triangles and their boxes.
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;

Kernel::Point_3 corner(const Points& positions, Index v)
{
    return {positions(v, 0), positions(v, 1), positions(v, 2)};
}

Triangles triangles_of(const PolygonMesh& surface)
{
    if (surface.n_faces() == 0)
        throw InputError("there are no faces, and so no surface to measure distances from");
    Triangles triangles;
    triangles.reserve(surface.n_corners());
    for (const Triangle& t : triangulate(surface))
        triangles.emplace_back(corner(surface.vertices, t[0]), corner(surface.vertices, t[1]),
                               corner(surface.vertices, t[2]));
    return triangles;
}

Point relative_to(const Point& origin, const Kernel::Point_3& p)
{
    return Point(p.x(), p.y(), p.z()) - origin;
}

double squared_distance_to_box(const Point& p, const CGAL::Bbox_3& box)
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double outside = std::max({box.min(k) - p(k), p(k) - box.max(k), 0.0});
        sum += outside * outside;
    }
    return sum;
}

/// Squared distance of the origin from its foot in the plane of the triangle, infinite if that lies outside.
double squared_distance_to_inside(const Point& a, const Point& b, const Point& c)
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
    // Not a number for a triangle without area: that is not inside either.
    const bool inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
    return inside ? foot.squaredNorm() : std::numeric_limits<double>::infinity();
}

/// Squared distance of the origin from the segment between a and b, which may be one point.
double squared_distance_to_segment(const Point& a, const Point& b)
{
    const Point u = b - a;
    const double uu = u.squaredNorm();
    if (!(uu > 0.0))
        return std::min(a.squaredNorm(), b.squaredNorm());
    const double s = std::clamp(-a.dot(u) / uu, 0.0, 1.0);
    return std::min(b.squaredNorm(), (a + s * u).squaredNorm());
}

}  // namespace

double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c)
{
    return std::min({squared_distance_to_segment(a, b), squared_distance_to_segment(b, c),
                     squared_distance_to_segment(c, a), squared_distance_to_inside(a, b, c)});
}

namespace {

/// Descends the tree, nearer boxes first, and keeps the smallest squared distance. CGAL's trees require these names.
class NearestSearch {
  public:
    using Priority = double;

    [[nodiscard]] double squared() const { return squared_; }
    [[nodiscard]] bool go_further() const { return squared_ > 0.0; }

    void intersection(const Point& p, const Primitive& primitive)
    {
        const Kernel::Triangle_3& t = *primitive.id();
        squared_ = std::min(
            squared_, squared_distance_to_triangle(relative_to(p, t[0]), relative_to(p, t[1]), relative_to(p, t[2])));
    }

    template <class Node>
    [[nodiscard]] bool do_intersect(const Point& p, const Node& node) const
    {
        return squared_distance_to_box(p, node.bbox()) < squared_;
    }

    template <class Node>
    [[nodiscard]] std::pair<bool, Priority> do_intersect_with_priority(const Point& p, const Node& node) const
    {
        const double squared = squared_distance_to_box(p, node.bbox());
        return {squared < squared_, -squared};
    }

  private:
    double squared_ = std::numeric_limits<double>::infinity();
};

}  // namespace

class SurfaceDistance::Tree {
  public:
    explicit Tree(const PolygonMesh& surface)
        : triangles_(triangles_of(surface))
        , tree_(triangles_.begin(), triangles_.end())
    {
        tree_.do_not_accelerate_distance_queries();
        tree_.build();
    }

    [[nodiscard]] double distance(const Point& p) const
    {
        NearestSearch search;
        tree_.traversal_with_priority(p, search);
        return std::sqrt(search.squared());
    }

  private:
    Triangles triangles_;
    CGAL::AABB_tree<Traits> tree_;
};

SurfaceDistance::SurfaceDistance(const PolygonMesh& surface)
    : tree_(std::make_unique<const Tree>(surface))
{
}

SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

std::vector<double> SurfaceDistance::operator()(const Points& points) const
{
    std::vector<double> distances(static_cast<std::size_t>(points.rows()));
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        distances[static_cast<std::size_t>(v)] = tree_->distance(points.row(v));
    return distances;
}

LengthStatistics surface_distance(const PolygonMesh& from, const PolygonMesh& to)
{
    if (from.n_faces() == 0)
        throw InputError("there are no faces, and so no vertices of a surface to measure distances of");
    std::vector<double> distances = SurfaceDistance(to)(from.vertices);
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
