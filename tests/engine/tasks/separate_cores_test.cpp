#include <cstddef>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <oneapi/tbb/info.h>
#include <sched.h>

#include "engine/tasks/separate_cores.h"

using seamflow::SeparateCores;

namespace {

cpu_set_t allowed_cores()
{
    cpu_set_t allowed;
    CHECK(::sched_getaffinity(0, sizeof allowed, &allowed) == 0);
    return allowed;
}

void allow(const cpu_set_t& cores)
{
    CHECK(::sched_setaffinity(0, sizeof cores, &cores) == 0);
}

cpu_set_t only(int core)
{
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(core), &one);
    return one;
}

/// Lets a second thread enter that runs on a core and may use these.
/// @returns the core on which it then is.
int core_after_entering(SeparateCores& cores, int place, int core, const cpu_set_t& allowed)
{
    int after = -1;
    std::thread second([&] {
        allow(only(core));
        allow(allowed);
        cores.enter(place);
        after = ::sched_getcpu();
        const cpu_set_t still_allowed = allowed_cores();
        CHECK(CPU_EQUAL(&still_allowed, &allowed));
        cores.leave(place);
    });
    second.join();
    return after;
}

}  // namespace

TEST_CASE("a thread leaves the core of another one of its arena, if it may")
{
    SeparateCores cores(2);
    const cpu_set_t allowed = allowed_cores();
    const int core = ::sched_getcpu();
    static_cast<void>(oneapi::tbb::info::default_concurrency());  // counts the cores once
    allow(only(core));
    cores.enter(0);
    // A busy machine may move it back at once, but not each time.
    bool has_moved = CPU_COUNT(&allowed) == 1;
    for (int i = 0; i < 20 && !has_moved; ++i)
        has_moved = core_after_entering(cores, 1, core, allowed) != core;
    CHECK(has_moved);
    CHECK(core_after_entering(cores, 1, core, only(core)) == core);
    core_after_entering(cores, 2, core, allowed);  // beyond the places: left alone
    cores.leave(0);
    allow(allowed);
}
