#pragma once

#include <array>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The planes at which the values of one coordinate lie: origin + k step, for whole numbers k. Values come so where
/// they were rounded to multiples of a step: voxels, slices of a scan, heights in whole metres.
struct CoordinateSteps {
    /// In units of length; 0: the values lie on no such planes.
    double step = 0.0;
    double origin = 0.0;

    /// Whether this value lies on a plane, up to a small fraction of a step.
    /// @pre step > 0
    [[nodiscard]] bool has(double value) const;

    /// The number k of the nearest plane.
    /// @pre step > 0
    [[nodiscard]] double plane_of(double value) const;
};

/// Finds the steps of x, y and z: those with which most vertices lie on planes, at least four fifths of them. The
/// others may lie anywhere, as after a cut. Of steps with about as many vertices, the largest counts.
/// @param points #V by 3. @param length a length of edges: planes nearer to each other than a two-hundredth of it are
/// not told apart, and values nearer than a hundred-thousandth are one value.
std::array<CoordinateSteps, 3> find_coordinate_steps(const Points& points, double length,
                                                     const Executor& exec = run_serially);

}  // namespace seamflow
