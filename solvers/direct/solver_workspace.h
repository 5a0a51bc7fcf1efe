#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "solvers/direct/columns.h"

namespace seamflow {

/// What an LdlSolver needs while it works: one for each thread. Grows to what the largest matrix needs.
struct LdlWorkspace {
    /// Per unknown: its row in the block that is in the making.
    std::vector<Index> row_of;
    /// Of one update.
    std::vector<Index> target_rows;
    /// Of the columns of a supernode: the matrix's diagonal.
    std::vector<double> diagonal;
    /// The block of unknowns that are kept together at the end, in either precision.
    std::tuple<std::vector<float>, std::vector<double>> last;
};

/// What an LuSolver needs while it works: one for each thread. Grows to what the largest matrix needs.
struct LuWorkspace {
    /// Per unknown: an entry of the column of L and one of the row of U that are in the making.
    std::vector<Eigen::Array2d> elimination;
    /// Per unknown: the sum of the magnitudes in its row of the matrix.
    std::vector<double> row_sizes;
    /// Per unknown: three right-hand sides, and a number that plays no part.
    std::vector<Eigen::Array4d> solution;
};

/// CHOLMOD's own state, and its memory for solving: what a CholmodSolver needs while it works.
class CholmodWorkspace {
  public:
    CholmodWorkspace();
    ~CholmodWorkspace();
    CholmodWorkspace(CholmodWorkspace&&) noexcept;
    CholmodWorkspace& operator=(CholmodWorkspace&&) noexcept;

    /// Known to the file that calls CHOLMOD alone.
    struct State;
    [[nodiscard]] State& state();

  private:
    /// Nothing until it is needed.
    std::unique_ptr<State> state_;
};

/// What systems need while they work and not after: one for each thread. Three columns wide they are as long as the
/// last system needed, the others as the largest.
struct SolverWorkspace {
    CholmodWorkspace cholmod;
    LdlWorkspace ldl;
    LuWorkspace lu;
    /// Of a matrix.
    std::vector<double> values;
    /// Per vertex.
    std::vector<double> diagonal;
    std::vector<double> mass;
    /// #local by 3: what positions leave of the equations.
    Points residual;
    /// #own by 3: Vᵏ⁺¹ - Vᵏ, in the making.
    Points increments;
    Columns right_hand_side;
    Columns solution;
    /// #own by 3.
    Points positions;
    /// #own by 3: what a step is applied to instead of Vᵏ.
    Points data;
    /// #local by 3: what is known of the other side, on Γ and in the halo.
    Points other_side;
};

}  // namespace seamflow
