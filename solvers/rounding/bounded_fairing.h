#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// A box around each vertex, in which it has to stay, and within a distance of the middle.
struct Boxes {
    /// #V by 3: the middles of the boxes, and the largest distance from the middle along each axis, at least 0.
    const Points& middles;
    const Points& half_widths;
    /// #V: bit k is 1 where the surface is flat across axis k (see flat_facets); empty: nowhere.
    std::span<const std::uint8_t> flat = {};
    double furthest = std::numeric_limits<double>::infinity();

    /// Moves some coordinates to the nearest ones in a box, and from there towards its middle where that is further
    /// than the largest distance. A coordinate of half-width 0 gets the bits of the middle.
    template <int N>
    [[nodiscard]] static Eigen::Matrix<double, 1, N>
    nearest(const Eigen::Matrix<double, 1, N>& middle, const Eigen::Matrix<double, 1, N>& half_width,
            const Eigen::Matrix<double, 1, N>& coordinates, double furthest)
    {
        Eigen::Matrix<double, 1, N> clamped = coordinates.cwiseMax(middle - half_width).cwiseMin(middle + half_width);
        if (std::isfinite(furthest))
            if (const double distance = (clamped - middle).norm(); distance > furthest)
                clamped = middle + (furthest / distance) * (clamped - middle);
        return (half_width.array() > 0.0).select(clamped, middle);
    }

    /// Moves a position to the nearest one in the box of vertex v.
    [[nodiscard]] Point nearest(Index v, const Point& position) const
    {
        return nearest<3>(middles.row(v), half_widths.row(v), position, furthest);
    }
};

/// The effort of a fairing.
struct FairingReport {
    /// The number of iterations that were taken, and the largest motion of a coordinate in the last one, in units of
    /// length.
    int iterations = 0;
    double last_motion = 0.0;
};

/// When a fairing ends.
struct FairingStop {
    int most_iterations = 0;
    /// When no coordinate moves further than this in an iteration, in units of length, for a few iterations.
    double motion = 0.0;
};

/// Finds the fairest surface in the boxes (Lempitsky, Surface extraction from binary volumes with higher-order
/// smoothness, 2010): the positions X that minimise ‖L X‖², with the umbrella (L X)_v = (Σ_w (x_v - x_w)) / d̄ over the
/// neighbours w of vertex v, and d̄ the mean number of neighbours. Takes iterations of the accelerated projected
/// gradient (Beck, Teboulle, A fast iterative shrinkage-thresholding algorithm, 2009), which begins anew whenever an
/// iteration would go back (O'Donoghue, Candès, Adaptive restart for accelerated gradient schemes, 2015). The boxes
/// hold exactly after each iteration. Bits do not depend on how loops are run.
/// @param neighbours #V: the vertices that share an edge with each vertex.
/// @param positions #V by 3: in the boxes; replaced.
FairingReport fair_in_boxes(const IndexLists& neighbours, const Boxes& boxes, const FairingStop& stop,
                            Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
