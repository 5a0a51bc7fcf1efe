#pragma once

#include <memory>

#include "samples/benchmark/methods/method.h"
#include "samples/benchmark/methods/whole_system.h"

namespace seamflow {

/// A third-party solver for the equations of the whole mesh, step after step. All functions throw ComputationError if
/// the library fails.
class PeerSolver {
  public:
    virtual ~PeerSolver() = default;

    /// Called once, before the values are known.
    /// @param system must outlive the solver.
    virtual void analyse(const WholeSystem& system) = 0;

    /// Factorises, or makes the preconditioner, for the values that the system has now.
    virtual void prepare(const WholeSystem& system) = 0;

    /// Solves for all three columns.
    /// @param solution n by 3. In: a start for iterations. Out: the solution.
    /// @returns iterations of all columns; 0 for direct solvers.
    virtual int solve(const WholeSystem& system, Columns& solution) = 0;
};

std::unique_ptr<PeerSolver> make_cholmod_solver();

/// @param tolerance as in MethodTask.
/// @throws ComputationError if the program was built without it.
std::unique_ptr<PeerSolver> make_amg_solver(double tolerance);

/// Whether make_amg_solver is available.
bool has_amg();

}  // namespace seamflow
