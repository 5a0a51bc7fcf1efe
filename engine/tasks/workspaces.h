#pragma once

#include <vector>

#include "solvers/direct/solver_workspace.h"

namespace seamflow {

/// A SolverWorkspace for each thread of the arena in which this is constructed and used.
class Workspaces {
  public:
    Workspaces();

    /// That of the calling thread.
    SolverWorkspace& local();

    /// How many threads the arena has.
    [[nodiscard]] Index size() const { return n_threads_; }

  private:
    Index n_threads_;
    std::vector<SolverWorkspace> workspaces_;
};

}  // namespace seamflow
