#pragma once

#include <vector>

#include "solvers/direct/solver_workspace.h"

namespace seamflow {

/// A SolverWorkspace for each thread of the arena in which this is constructed and used.
class Workspaces {
  public:
    Workspaces();

    /// The workspace of the calling thread.
    SolverWorkspace& local();

    /// The number of threads of the arena.
    [[nodiscard]] Index size() const { return n_threads_; }

  private:
    Index n_threads_;
    std::vector<SolverWorkspace> workspaces_;
};

}  // namespace seamflow
