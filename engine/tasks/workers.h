#pragma once

#include <functional>
#include <memory>

#include "partition/executor.h"

namespace seamflow {

/// The threads that a flow runs on. While this object lives, BLAS is single-threaded: the tasks run in parallel, and
/// libraries that start threads of their own inside each task slow all of them down.
class Workers {
  public:
    /// @param threads their number, the calling thread included: fewer where the program has set a lower limit. 0: the
    /// arena of the caller with the limits it has. In that arena a waiting thread may meanwhile run other tasks of the
    /// caller, as everywhere in oneTBB; with a number the flow has its own arena.
    /// @throws OptionError for a number below 0 or above most_threads.
    explicit Workers(int threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Runs `work` so that everything parallel in it uses these threads.
    void execute(const std::function<void()>& work);

    /// An executor whose loops run on these threads, which must outlive it.
    [[nodiscard]] Executor exec();

    /// The number of threads, within the limits that the program has set (oneTBB's global_control).
    [[nodiscard]] int threads() const;

  private:
    class Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace seamflow
