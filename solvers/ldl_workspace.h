#pragma once

#include <vector>

#include "partition/index.h"

namespace seamflow {

/// What an LdlSolver needs while it works: one for each thread. Grows to what the largest matrix needs.
struct LdlWorkspace {
    /// Per unknown: its row in the block that is in the making.
    std::vector<Index> row_of;
    /// Of one update.
    std::vector<Index> target_rows;
    /// #unknowns by 3, row by row.
    std::vector<double> solution;
};

}  // namespace seamflow
