#include "engine/steppers/directed_motion.h"

#include <algorithm>

namespace seamflow {

namespace {

/// Where the cosine between a line and the normal of the surface is smaller, as at walls along the line, the moved
/// surface is not followed all the way.
constexpr double least_cosine = 0.7;

/// The way along a line of direction d to the plane through the moved point with normal n.
double way_to_surface(const Point& way, const Point& d, const Point& n)
{
    const double along = way.dot(d);
    const double cosine = d.dot(n);
    const Point aside = way - along * d;
    return along + aside.dot(n) * cosine / std::max(cosine * cosine, least_cosine * least_cosine);
}

/// Replaces each way by another one, coordinate by coordinate.
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
    : direction_(direction.vector.stableNormalized())
    , follows_normals_(direction.kind == MotionDirection::Kind::Normal)
    , normals_(mesh, topology)
{
}

void DirectedMotion::project(const Points& before, Points& after, const Executor& exec) const
{
    const Points moved = after;
    move_each(before, after, exec, [&](Index v, const Point& way) {
        const Point n = normals_(v, moved);
        return follows_normals_ ? Point(way.dot(n) * n) : Point(way_to_surface(way, direction_, n) * direction_);
    });
}

void DirectedMotion::straighten(const Points& before, Points& after, const Executor& exec) const
{
    move_each(before, after, exec, [&](Index, const Point& way) { return Point(way.dot(direction_) * direction_); });
}

}  // namespace seamflow
