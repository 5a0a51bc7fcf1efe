#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "solvers/cholmod_workspace.h"
#include "solvers/columns.h"
#include "solvers/factor_memory.h"
#include "solvers/ldl_workspace.h"
#include "solvers/lu_workspace.h"

namespace seamflow {

/// What systems need while they work and not after: one for each thread. Three columns wide they are as long as the
/// last system needed, the others as the largest.
struct SolverWorkspace {
    /// Factors outlive the work: this is not the workspace's own. The same in all workspaces that a system meets.
    FactorMemory* factors = &heap_memory();
    CholmodWorkspace cholmod;
    LdlWorkspace ldl;
    LuWorkspace lu;
    /// Of a matrix.
    std::vector<double> values;
    /// Per vertex.
    std::vector<double> diagonal;
    std::vector<double> mass;
    /// #local by 3: dt K V.
    Points product;
    Columns right_hand_side;
    Columns solution;
    /// #own by 3.
    Points positions;
    /// #unknowns by 3: Vᵏ⁺¹ - Vᵏ, in the making.
    Points increment;
    /// #local by 3: what is known of the other side, on Γ and in the halo.
    Points other_side;
};

}  // namespace seamflow
