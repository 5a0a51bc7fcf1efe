#pragma once

#include <vector>

#include <Eigen/Core>

namespace seamflow {

/// What an LuSolver needs while it works: one for each thread. Grows to what the largest matrix needs.
struct LuWorkspace {
    /// Per unknown: an entry of the column of L and one of the row of U that are in the making.
    std::vector<Eigen::Array2d> elimination;
    /// Per unknown: the sum of the magnitudes in its row of the matrix.
    std::vector<double> row_sizes;
    /// Per unknown: three right-hand sides, and a number that plays no part.
    std::vector<Eigen::Array4d> solution;
};

}  // namespace seamflow
