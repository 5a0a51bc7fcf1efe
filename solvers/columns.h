#pragma once

#include <Eigen/Core>

namespace seamflow {

/// Three right-hand sides or solutions, n by 3, one contiguous column per coordinate.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

}  // namespace seamflow
