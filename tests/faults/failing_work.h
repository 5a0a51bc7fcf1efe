#pragma once

namespace seamflow::test {

/// What a failing task throws.
struct TaskFailure {
    int task = 0;
};

/// While this lives, a task of each graph that is made throws a TaskFailure in one of its runs. One at a time.
class FailingTask {
  public:
    /// @param task its number, from 1, in the order in which tasks are added.
    /// @param run in which it fails, from 1.
    FailingTask(int task, int run);
    ~FailingTask();
    FailingTask(const FailingTask&) = delete;
    FailingTask& operator=(const FailingTask&) = delete;

    /// Whether there was such a task, and it has failed.
    [[nodiscard]] bool has_failed() const;
};

/// While this lives the n-th numeric factorisation, from 1, finds its matrix singular, and if told so all after it: by
/// LdlSolver, LuSolver and UMFPACK (CHOLMOD factorises what is too large for a test). A program is told by the
/// environment variable FAIL_FACTORISATION: from this one on, all fail. One at a time.
class FailingFactorisation {
  public:
    enum class After { Works, Fails };

    FailingFactorisation(int n, After after);
    ~FailingFactorisation();
    FailingFactorisation(const FailingFactorisation&) = delete;
    FailingFactorisation& operator=(const FailingFactorisation&) = delete;

    [[nodiscard]] bool has_failed() const;
};

}  // namespace seamflow::test
