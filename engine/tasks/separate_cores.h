#pragma once

#include <mutex>
#include <vector>

namespace seamflow {

/// Moves a thread that enters an arena to another core if one of the arena's threads already runs on its core. Linux
/// starts and wakes a thread on the core of the thread that does so, and if it does not know which cores share a cache,
/// as in many virtual machines, it leaves both on that core for tens of milliseconds, longer than a short flow takes.
/// No thread is bound to a core, and no thread leaves the cores that the caller has allowed it.
class SeparateCores {
  public:
    /// @param threads the largest number of threads in the arena.
    explicit SeparateCores(int threads);

    /// To be called when the calling thread enters the arena.
    /// @param slot its slot in the arena, from 0.
    void enter(int slot);
    /// To be called when the thread leaves the arena.
    void leave(int slot);

  private:
    std::mutex mutex_;
    /// For each slot, the core on which its thread entered; negative without a thread.
    std::vector<int> core_;
};

}  // namespace seamflow
