#pragma once

#include <memory>

namespace seamflow {

/// CHOLMOD's own state, and its memory for solving: what a CholmodSolver needs while it works.
class CholmodWorkspace {
  public:
    CholmodWorkspace();
    ~CholmodWorkspace();
    CholmodWorkspace(CholmodWorkspace&&) noexcept;
    CholmodWorkspace& operator=(CholmodWorkspace&&) noexcept;

    /// Known to the file that calls CHOLMOD alone.
    struct State;
    [[nodiscard]] State& state() { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

}  // namespace seamflow
