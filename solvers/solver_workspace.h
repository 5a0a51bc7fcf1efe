#pragma once

#include <vector>

#include "solvers/cholmod_workspace.h"
#include "solvers/columns.h"
#include "solvers/lu_workspace.h"

namespace seamflow {

/// What systems need while they work and not after: one for each thread. Grows to what the largest system needs.
struct SolverWorkspace {
    CholmodWorkspace cholmod;
    LuWorkspace lu;
    /// Of a matrix.
    std::vector<double> values;
    /// Per vertex.
    std::vector<double> diagonal;
    std::vector<double> mass;
    Columns right_hand_side;
};

}  // namespace seamflow
