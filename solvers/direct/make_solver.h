#pragma once

#include <memory>

#include "solvers/direct/direct_solver.h"
#include "solvers/sparse/sparse_pattern.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// For symmetric positive definite matrices, in the given order of the unknowns.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param factorisation not Umfpack.
/// @param tree if already known; otherwise empty.
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_symmetric_solver(SparsePattern upper, Factorisation factorisation,
                                                    SolverWorkspace& workspace, const EliminationTree& tree = {});

/// For any matrix.
/// @param pattern must outlive the solver.
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_general_solver(const SparsePattern& pattern, Factorisation factorisation);

}  // namespace seamflow
