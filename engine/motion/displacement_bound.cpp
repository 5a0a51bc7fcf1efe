#include "engine/motion/displacement_bound.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/tasks/parallel_executor.h"

namespace seamflow {

namespace {

/// t of D + t K: corrections are smooth over about √t edges.
constexpr double smoothness = 25.0;
/// The largest eigenvalue of D + t K over D; the smallest is 1.
constexpr double largest_eigenvalue = 1.0 + 2.0 * smoothness;
/// The accuracy of a correction, relative to the correction.
constexpr double accuracy = 1e-4;

}  // namespace

MotionBound bound_along(const MotionDirection& direction, const MotionBound& bound)
{
    if (direction.kind != MotionDirection::Kind::Vector || !bound.along_axes)
        return bound;
    const Point unit = direction.vector.stableNormalized();
    double distance = std::numeric_limits<double>::infinity();
    for (unsigned axis = 0; axis < 3; ++axis)
        if (unit[axis] != 0.0)
            distance = std::min(distance, bound.lengths[axis].value / std::abs(unit[axis]));
    return distance;
}

DisplacementBound::DisplacementBound(const PolygonMesh& mesh, const Topology& topology, const MotionBound& bound)
    : lengths_(bound.lengths[0].value, bound.lengths[1].value, bound.lengths[2].value)
    , along_axes_(bound.along_axes)
    , initial_(mesh.vertices)
{
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const std::vector<Index> around = neighbours_of(mesh, topology, v);
        neighbours_.values.insert(neighbours_.values.end(), around.begin(), around.end());
        neighbours_.close();
    }
}

bool DisplacementBound::is_beyond(const Point& displacement) const
{
    return along_axes_ ? (displacement.cwiseAbs().array() > lengths_.array()).any()
                       : displacement.stableNorm() > lengths_.x();
}

Point DisplacementBound::bounded(const Point& displacement) const
{
    if (!is_beyond(displacement))
        return displacement;
    return along_axes_ ? Point(displacement.cwiseMax(-lengths_).cwiseMin(lengths_))
                       : Point(displacement * (lengths_.x() / displacement.stableNorm()));
}

void DisplacementBound::apply(Points& positions) const
{
    const auto n = static_cast<Index>(initial_.rows());
    const Points displacements = positions - initial_;
    const auto moves = [&](Index v) { return !displacements.row(v).isZero(0.0); };
    std::atomic<bool> any_is_beyond = false;
    for_each(run_in_parallel, n, [&](Index v) {
        if (moves(v) && is_beyond(displacements.row(v)))
            any_is_beyond = true;
    });
    if (!any_is_beyond)
        return;

    // Nesterov's method for a strongly convex function: each step begins ahead of the last correction, in the direction
    // in which the correction has changed.
    const double root = std::sqrt(largest_eigenvalue);
    const double momentum = (root - 1.0) / (root + 1.0);
    const int n_steps = static_cast<int>(std::ceil(-root * std::log(accuracy)));
    Points correction = Points::Zero(n, 3);
    Points before = correction;
    Points ahead = correction;
    for (int step = 0; step < n_steps; ++step) {
        for_each(run_in_parallel, n, [&](Index v) {
            ahead.row(v) = correction.row(v) + momentum * (correction.row(v) - before.row(v));
            before.row(v) = correction.row(v);
        });
        for_each(run_in_parallel, n, [&](Index v) {
            if (!moves(v))
                return;
            Point mean = Point::Zero();
            for (const Index w : neighbours_[v])
                mean += ahead.row(w);
            mean /= static_cast<double>(neighbours_[v].size());
            const Point here = ahead.row(v);
            // Multiplied by the inverse of D.
            const Point gradient = here + smoothness * (here - mean);
            const Point displacement = displacements.row(v);
            correction.row(v) = bounded(displacement + here - gradient / largest_eigenvalue) - displacement;
        });
    }
    for_each(run_in_parallel, n, [&](Index v) {
        if (moves(v))
            positions.row(v) = Point(initial_.row(v)) + bounded(displacements.row(v) + correction.row(v));
    });
}

}  // namespace seamflow
