#pragma once

#include <span>
#include <string>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Positions with 16 bits per coordinate: 0 at the lower corner of their bounding box, 65535 at the upper one, which is
/// enough for viewing.
struct PackedPoints {
    /// In units of length; 0 without vertices.
    Eigen::RowVector3d lower = Eigen::RowVector3d::Zero();
    Eigen::RowVector3d upper = Eigen::RowVector3d::Zero();
    /// See packed(): 3 columns of 16 bits.
    std::string data;
};

/// @param positions #V by 3, finite.
PackedPoints pack_points(const Points& positions);

/// Numbers of at least 0 in 16 bits each: round(65534 √(value / largest)), which keeps small ones apart; 65535 marks
/// values that are not finite.
struct PackedValues {
    /// Of the finite numbers; 0 if there are none.
    double largest = 0.0;
    /// 99 % of the finite numbers are not larger: a good end for a colour scale, which the largest need not be.
    double percentile_99 = 0.0;
    /// See packed(): one column of 16 bits.
    std::string data;
};

PackedValues pack_values(std::span<const double> values);

}  // namespace seamflow
