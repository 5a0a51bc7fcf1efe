#pragma once

#include <mutex>
#include <vector>

namespace seamflow {

/// Moves a thread that enters an arena to another core if one of the arena's threads runs on its core already. Linux
/// starts and wakes a thread on the core of the thread that does so, and where it does not know which cores share a
/// cache, as in many virtual machines, it leaves both there for tens of milliseconds: a short flow is over by then. No
/// thread is bound to a core, and none leaves the cores that the caller has allowed it.
class SeparateCores {
  public:
    /// @param threads the largest number of them in the arena.
    explicit SeparateCores(int threads);

    /// The calling thread takes a place of the arena, from 0.
    void enter(int place);
    void leave(int place);

  private:
    std::mutex mutex_;
    /// For each place the core of its thread when that entered; negative without one.
    std::vector<int> core_;
};

}  // namespace seamflow
