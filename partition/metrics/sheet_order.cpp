#include "partition/metrics/sheet_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include <xxhash.h>

namespace seamflow {

namespace {

/// Faces at a smaller angle, in radians, lie on each other: rounding is far smaller, except for needles.
constexpr double smallest_angle = 1e-10;

/// The vector scaled to length 1; 0 for a vector without length or too long for a double.
Point direction_of(const Point& vector)
{
    return vector.allFinite() ? vector.stableNormalized() : Point(Point::Zero());
}

/// The pseudorandom displacement of a vertex: in each coordinate a number from -½ to ½ that depends on the number of
/// the vertex.
Point displacement_of(Index v)
{
    constexpr int n_bits = 21;
    const std::uint64_t hash = XXH3_64bits(&v, sizeof v);
    const auto part = [&](int c) { return static_cast<double>(hash >> (c * n_bits) & ((1U << n_bits) - 1U)); };
    return Point(part(0), part(1), part(2)) / (1U << n_bits) - Point::Constant(0.5);
}

/// The derivative of vector_area while all vertices move along displacement_of.
Point vector_area_rate(std::span<const Index> corners, const Points& positions)
{
    Point sum = Point::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index before = corners[k > 0 ? k - 1 : corners.size() - 1];
        const Index after = corners[k + 1 < corners.size() ? k + 1 : 0];
        sum += displacement_of(corners[k]).cross(positions.row(after) - positions.row(before));
    }
    return 0.5 * sum;
}

/// The corners of a face, beginning at its lowest corner and running towards the lower one of its two neighbours, so
/// that repeated faces have the same list; and whether the list runs in the sense of the face.
std::pair<std::vector<Index>, bool> sorted_corners(std::span<const Index> face)
{
    std::vector<Index> corners(face.begin(), face.end());
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    const bool is_same_sense = corners[1] < corners.back();
    if (!is_same_sense)
        std::reverse(corners.begin() + 1, corners.end());
    return {std::move(corners), is_same_sense};
}

/// Begins the cycle after a gap, so that no faces that lie on each other are at both ends of the list.
void begin_behind_gap(std::vector<SheetSpoke>& spokes)
{
    if (spokes.front().angle + 2.0 * std::numbers::pi - spokes.back().angle > smallest_angle)
        return;
    const auto gap = std::ranges::adjacent_find(
        spokes, [](const SheetSpoke& one, const SheetSpoke& next) { return next.angle - one.angle > smallest_angle; });
    if (gap != spokes.end())
        std::rotate(spokes.begin(), gap + 1, spokes.end());
}

/// Calls action with the runs of spokes in which each spoke belongs to the one before it.
template <class Belongs, class Action>
void for_each_run(std::span<SheetSpoke> spokes, Belongs&& belongs, Action&& action)
{
    for (std::size_t begin = 0; begin < spokes.size();) {
        std::size_t end = begin + 1;
        while (end < spokes.size() && belongs(spokes[end - 1], spokes[end]))
            ++end;
        action(spokes.subspan(begin, end - begin));
        begin = end;
    }
}

}  // namespace

/// The spoke of half-edge h. Its angle is that of the direction from the edge into the face, perpendicular to the edge,
/// relative to the first such direction that is not zero. The bits depend neither on the first corner of the face nor
/// on its sense.
SheetSpoke SheetOrder::spoke_of(Index h, const Point& axis, Point& first) const
{
    const auto [corners, is_same_sense] = sorted_corners(mesh_.face(topology_.face_of[h]));
    const double sign = runs_up(h) == is_same_sense ? 1.0 : -1.0;
    const Point area = vector_area(corners, positions_);
    const Point inwards = sign * direction_of(area.cross(axis));
    if (first.isZero(0.0))
        first = inwards;
    // With area × axis = |area| inwards, the angle changes by axis × inwards · d(area × axis) / |area|. The change of
    // the axis is left out: it is the same for all faces that lie on each other.
    const double rate = -sign * vector_area_rate(corners, positions_).dot(inwards) / area.stableNorm();
    return {std::atan2(inwards.dot(axis.cross(first)), inwards.dot(first)), std::isfinite(rate) ? rate : 0.0, h, false};
}

std::vector<SheetSpoke> SheetOrder::around(Index h) const
{
    const auto [lower, higher] = std::minmax(mesh_.face_vertices[h], mesh_.face_vertices[topology_.next(mesh_, h)]);
    const Point axis = direction_of(positions_.row(higher) - positions_.row(lower));
    std::vector<SheetSpoke> spokes;
    Point first = Point::Zero();
    spokes.push_back(spoke_of(h, axis, first));
    for (Index other = topology_.next_at_junction(h); other != h; other = topology_.next_at_junction(other))
        spokes.push_back(spoke_of(other, axis, first));
    std::ranges::sort(spokes, {}, [](const SheetSpoke& s) { return std::tuple(s.angle, s.halfedge); });
    begin_behind_gap(spokes);
    // After begin_behind_gap an angle near -π may follow one near π: their difference, about -2π, is also no gap.
    const auto lies_on = [](const SheetSpoke& one, const SheetSpoke& next) {
        return next.angle - one.angle <= smallest_angle;
    };
    // Faces with the same corners have the same rate, bit for bit (see spoke_of).
    const auto have_same_corners = [](const SheetSpoke& one, const SheetSpoke& next) { return one.rate == next.rate; };
    for_each_run(std::span(spokes), lies_on, [&](std::span<SheetSpoke> together) {
        std::ranges::sort(together, {}, [](const SheetSpoke& s) { return std::tuple(s.rate, s.halfedge); });
        for_each_run(together, have_same_corners, [&](std::span<SheetSpoke> repeated) {
            if (!runs_up(repeated.front().halfedge))
                std::ranges::reverse(repeated);
        });
        for (SheetSpoke& spoke : together.subspan(1))
            spoke.lies_on_previous = true;
    });
    return spokes;
}

}  // namespace seamflow
