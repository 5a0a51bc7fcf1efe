#include "engine/tasks/separate_cores.h"

#include <algorithm>
#include <cstddef>

#include <sched.h>

namespace seamflow {

namespace {

constexpr int no_core = -1;

/// Moves the calling thread to a core that it may use and that is not in the list, if there is one.
void leave_for_another(const std::vector<int>& cores)
{
    cpu_set_t allowed;
    if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return;
    cpu_set_t free = allowed;
    for (const int core : cores)
        if (core != no_core)
            CPU_CLR(static_cast<std::size_t>(core), &free);
    // Linux moves a thread at once from a core that it may no longer use; then the thread may use all its cores again.
    if (CPU_COUNT(&free) > 0 && ::sched_setaffinity(0, sizeof free, &free) == 0)
        ::sched_setaffinity(0, sizeof allowed, &allowed);
}

}  // namespace

SeparateCores::SeparateCores(int threads)
    : core_(static_cast<std::size_t>(threads), no_core)
{
}

void SeparateCores::enter(int slot)
{
    leave(slot);
    const auto own = static_cast<std::size_t>(slot);
    if (own >= core_.size())
        return;
    const std::lock_guard lock(mutex_);
    if (std::find(core_.begin(), core_.end(), ::sched_getcpu()) != core_.end())
        leave_for_another(core_);
    core_[own] = ::sched_getcpu();
}

void SeparateCores::leave(int slot)
{
    const std::lock_guard lock(mutex_);
    if (const auto own = static_cast<std::size_t>(slot); own < core_.size())
        core_[own] = no_core;
}

}  // namespace seamflow
