#include "engine/motion/directed_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partition/metrics/fast_marching.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The least cosine between a line and the normal of the surface. With a smaller one the surface is nearly parallel to
/// the line, and rounding decides which of its points the line meets.
constexpr double least_cosine = 0.01;

/// The least such cosine near a silhouette, where the surface turns over as seen along the lines, and many lines miss
/// the moved surface. The motion is reduced where the cosine is smaller.
constexpr double least_cosine_at_silhouette = 0.7;

/// The length of a motion along a line, as a fraction of the distance from a silhouette, at which the two ways of
/// limiting the motion are averaged.
constexpr double halved_at = 1.0 / 16.0;

/// The length along a line of direction d to the plane through the moved point with normal n; reduced if the cosine of
/// d and n is below `least`.
double way_to_plane(const Point& way, const Point& d, const Point& n, double least)
{
    const double along = way.dot(d);
    const double cosine = d.dot(n);
    const Point aside = way - along * d;
    return along + aside.dot(n) * cosine / std::max(cosine * cosine, least * least);
}

/// Replaces the motion of each vertex by another one, coordinate by coordinate.
template <class NewWay>
void move_each(const Points& before, Points& after, const Executor& exec, NewWay&& new_way)
{
    for_each(exec, static_cast<Index>(after.rows()), [&](Index v) {
        const Point from = before.row(v);
        const Point way = after.row(v) - from;
        after.row(v) = from;
        if (way.isZero(0.0))
            return;
        const Point along = new_way(v, way);
        for (Index c = 0; c < 3; ++c)
            if (along[c] != 0.0)
                after(v, c) += along[c];
    });
}

}  // namespace

DirectedMotion::DirectedMotion(const PolygonMesh& mesh, const Topology& topology, const MotionDirection& direction)
    : mesh_(mesh)
    , topology_(topology)
    , direction_(direction.vector.stableNormalized())
    , follows_normals_(direction.kind == MotionDirection::Kind::Normal)
    , normals_(mesh, topology)
{
}

template <class Seen>
double DirectedMotion::longest_edge(Index v, const Points& positions, Seen&& seen) const
{
    double squared = 0.0;
    for (const Index corner : topology_.corners_at(v))
        for (const Index end : {topology_.next(mesh_, corner), topology_.previous(mesh_, corner)}) {
            const Point edge = positions.row(mesh_.face_vertices[end]) - positions.row(v);
            squared = std::max(squared, seen(edge).squaredNorm());
        }
    return std::sqrt(squared);
}

void DirectedMotion::project(const Points& before, Points& after, const Executor& exec) const
{
    const Points moved = after;
    if (follows_normals_) {
        move_each(before, after, exec, [&](Index v, const Point& way) {
            const Point n = normals_(v, moved);
            return Point(way.dot(n) * n);
        });
        return;
    }
    const std::vector<Index> silhouette =
        select(exec, mesh_.n_vertices(), [&](Index v) { return is_on_silhouette(v, before); });
    const std::vector<double> distances =
        distances_from(mesh_, topology_, silhouette, std::numeric_limits<double>::infinity());
    move_each(before, after, exec, [&](Index v, const Point& way) {
        if (misses_rim(v, way, moved))
            return Point(Point::Zero());
        const Point n = normals_(v, moved);
        const double shorter = way_to_plane(way, direction_, n, least_cosine_at_silhouette);
        if (std::abs(direction_.dot(n)) >= least_cosine_at_silhouette || n.isZero(0.0))
            return Point(shorter * direction_);
        const double whole = least_way(v, way, moved);
        const double relative = whole / (halved_at * distances[v]);
        // On the silhouette the distance is 0: without a motion, `relative` is then 0 / 0.
        return Point((whole == 0.0 ? 0.0 : shorter + (whole - shorter) / (1.0 + relative * relative)) * direction_);
    });
}

double DirectedMotion::least_way(Index v, const Point& way, const Points& moved) const
{
    const double along = way.dot(direction_);
    // Lines beside the surface may meet its steep planes far away, so that the motion at the boundary is limited by the
    // lengths of edges.
    const double furthest = topology_.kind[v] == VertexKind::Boundary
                                ? std::max(longest_edge(v, moved, [](const Point& edge) { return edge; }),
                                           (way - along * direction_).norm())
                                : std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Point& n) {
        const double to_plane = way_to_plane(way, direction_, n, least_cosine);
        if (!n.isZero(0.0) && std::abs(to_plane - along) <= furthest && std::abs(to_plane) < std::abs(least))
            least = to_plane;
    };
    consider(normals_(v, moved));
    for (const Index corner : topology_.corners_at(v))
        consider(vector_area(mesh_.face(topology_.face_of[corner]), moved).stableNormalized());
    return std::isfinite(least) ? least : 0.0;
}

bool DirectedMotion::misses_rim(Index v, const Point& way, const Points& moved) const
{
    const Point aside = way - way.dot(direction_) * direction_;
    return topology_.kind[v] == VertexKind::Boundary && aside.norm() > longest_edge(v, moved, [&](const Point& edge) {
                                                            return Point(edge - edge.dot(direction_) * direction_);
                                                        });
}

bool DirectedMotion::is_on_silhouette(Index v, const Points& positions) const
{
    if (topology_.kind[v] == VertexKind::Junction)
        return true;
    bool rises = false;
    bool falls = false;
    for (const Index corner : topology_.corners_at(v)) {
        const std::span<const Index> face = mesh_.face(topology_.face_of[corner]);
        const double area = area_above_rounding(face, positions);
        if (area == 0.0)
            continue;
        const double along = normals_.sense(corner) * vector_area(face, positions).dot(direction_) / area;
        rises = rises || along > -least_cosine;
        falls = falls || along < least_cosine;
    }
    return rises && falls;
}

void DirectedMotion::straighten(const Points& before, Points& after, const Executor& exec) const
{
    move_each(before, after, exec, [&](Index, const Point& way) { return Point(way.dot(direction_) * direction_); });
}

}  // namespace seamflow
