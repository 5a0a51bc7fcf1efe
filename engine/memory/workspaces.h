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

    [[nodiscard]] Index size() const { return static_cast<Index>(workspaces_.size()); }

  private:
    std::vector<SolverWorkspace> workspaces_;
};

}  // namespace seamflow
