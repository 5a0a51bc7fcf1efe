#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "solvers/direct/columns.h"

namespace seamflow {

/// Working memory of an LdlSolver: one per thread. Grows to the needs of the largest matrix.
struct LdlWorkspace {
    /// Per unknown: the index of its row in the panel being computed.
    std::vector<Index> row_of;
    /// Per row of an update by an earlier panel: the index of its row in the panel being computed.
    std::vector<Index> target_rows;
    /// The matrix's diagonal at the columns of a supernode.
    std::vector<double> diagonal;
    /// The block of unknowns that are kept together at the end, in either precision.
    std::tuple<std::vector<float>, std::vector<double>> last;
};

/// Working memory of an LuSolver: one per thread. Grows to the needs of the largest matrix.
struct LuWorkspace {
    /// Per unknown: an entry of the column of L and one of the row of U being computed.
    std::vector<Eigen::Array2d> elimination;
    /// Per unknown: the sum of the magnitudes in its row of the matrix.
    std::vector<double> row_sizes;
    /// Per unknown: three right-hand sides, and an unused number.
    std::vector<Eigen::Array4d> solution;
};

/// Working memory of CHOLMOD's solvers: CHOLMOD's own state, and its memory for solving.
class CholmodWorkspace {
  public:
    /// Defined only in the file that calls CHOLMOD.
    struct State;
    /// The state, made by the first call.
    [[nodiscard]] State& state();

  private:
    /// Null until it is needed.
    std::unique_ptr<State, void (*)(State*)> state_{nullptr, nullptr};
};

/// Temporary memory of systems: one per thread. Arrays of three columns are as long as the last system needed, other
/// arrays as long as the largest system needed.
struct SolverWorkspace {
    CholmodWorkspace cholmod;
    LdlWorkspace ldl;
    LuWorkspace lu;
    /// The entries of a matrix, in the order of its pattern.
    std::vector<double> values;
    /// Per vertex: the diagonal of dt K, and M.
    std::vector<double> diagonal;
    std::vector<double> mass;
    /// #local by 3: the residual of the equations.
    Points residual;
    /// #own by 3: Vᵏ⁺¹ - Vᵏ so far.
    Points increments;
    Columns right_hand_side;
    Columns solution;
    /// #own by 3: positions.
    Points positions;
    /// #own by 3: the data of a step, in place of Vᵏ.
    Points data;
    /// #local by 3: the latest known positions of the other side, on Γ and in the halo.
    Points other_side;
};

}  // namespace seamflow
