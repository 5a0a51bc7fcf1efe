#pragma once

#include <memory>

#include "partition/executor.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/sparse/sparse_pattern.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// Makes a solver for symmetric matrices that are positive definite or quasi-definite (see Pivots), in the given order
/// of the unknowns.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param factorisation is_available(), and not Umfpack; CHOLMOD's requires positive pivots, otherwise our own is used.
/// @param tree if already known; otherwise empty.
/// @param exec runs loops of our own factorisation on several threads; empty: everything runs on the calling thread.
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_symmetric_solver(SparsePattern upper, Factorisation factorisation,
                                                    SolverWorkspace& workspace, const EliminationTree& tree = {},
                                                    Executor exec = {}, Pivots pivots = Pivots::Positive);

/// Makes a solver for any matrix.
/// @param pattern must outlive the solver.
/// @param factorisation is_available().
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_general_solver(const SparsePattern& pattern, Factorisation factorisation);

}  // namespace seamflow
