#pragma once

#include <mutex>
#include <vector>

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

namespace seamflow {

/// Moves a thread that enters an arena to another core if one of the arena's threads runs on its core already. Linux
/// starts and wakes a thread on the core of the thread that does so, and where it does not know which cores share a
/// cache, as in many virtual machines, it leaves both there for tens of milliseconds: a short flow is over by then. No
/// thread is bound to a core, and none leaves the cores that the caller has allowed it.
class SeparateCores : private oneapi::tbb::task_scheduler_observer {
  public:
    /// @param arena must outlive this.
    /// @param threads the largest number of them in the arena.
    SeparateCores(oneapi::tbb::task_arena& arena, int threads);
    ~SeparateCores() override;
    SeparateCores(const SeparateCores&) = delete;
    SeparateCores& operator=(const SeparateCores&) = delete;

    /// The calling thread takes a place of the arena, from 0.
    void enter(int place);
    void leave(int place);

  private:
    void on_scheduler_entry(bool is_worker) override;
    void on_scheduler_exit(bool is_worker) override;

    std::mutex mutex_;
    /// For each place the core of its thread when that entered; negative without one.
    std::vector<int> core_;
};

}  // namespace seamflow
