#pragma once

#include <chrono>
#include <cstring>
#include <functional>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "tests/faults/failing_malloc.h"
#include "tests/support/allocations.h"

namespace seamflow::test {

/// Something that takes memory.
struct Work {
    /// Allocations of this fail.
    std::function<void()> run;
    /// What has come of it, for comparisons.
    std::function<std::string()> result;
    /// Checks what a run that has failed leaves.
    std::function<void()> check_failed = [] {};
    /// How often a run may lose one block: in the constructor of each of its nodes, oneTBB 2021.8 keeps two copies of a
    /// task by plain pointers, and loses the first where memory lacks for the second.
    long most_lost = 0;
    /// How allocations fail.
    std::vector<Failing> ways{Failing::Once, Failing::FromThenOn};
};

enum class Ending { Success, OutOfMemory, Other };

/// How a run with a failing allocation has ended. Without taking memory.
struct FailedRun {
    Ending ending = Ending::Success;
    char message[300] = {};
    bool has_failed = false;

    FailedRun(const std::function<void()>& run, long n, Failing failing)
    {
        const FailingAllocation allocation(n, failing);
        try {
            run();
        } catch (const std::bad_alloc&) {
            ending = Ending::OutOfMemory;
        } catch (const ComputationError& error) {
            note(error);
            ending = std::strstr(message, "memory") != nullptr ? Ending::OutOfMemory : Ending::Other;
        } catch (const std::exception& error) {
            note(error);
            ending = Ending::Other;
        }
        has_failed = FailingAllocation::has_failed();
    }

    void note(const std::exception& error) { std::strncpy(message, error.what(), sizeof message - 1); }
};

/// Blocks beyond these. A thread that has worked in an arena holds one until it leaves, which may be after the run:
/// those of a run that has succeeded are waited for, those of another one for a moment.
inline long blocks_beyond(long before, Ending ending)
{
    const auto patience = ending == Ending::Success ? std::chrono::milliseconds(20'000) : std::chrono::milliseconds(10);
    const auto latest = std::chrono::steady_clock::now() + patience;
    while (live_blocks() > before && std::chrono::steady_clock::now() < latest)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    return live_blocks() - before;
}

/// Runs it again and again, each time with the next allocation failing, alone or with all after it, until there are no
/// more. The caller always hears of it, or gets the same result, and no memory is lost.
inline void fail_every_allocation(const Work& work)
{
    static_cast<void>(has_failing_malloc());
    work.run();
    const std::string expected = work.result();
    for (const Failing failing : work.ways) {
        long n_lost = 0;
        for (long n = 1;; ++n) {
            CAPTURE(n);
            const long before = live_blocks();
            const FailedRun outcome(work.run, n, failing);
            const long lost = blocks_beyond(before, outcome.ending);
            if (!outcome.has_failed) {
                CHECK(n > 1);
                CHECK(outcome.ending == Ending::Success);
                CHECK(work.result() == expected);
                break;
            }
            CAPTURE(std::string(outcome.message));
            CAPTURE(lost);
            // One that a thread has kept from a run without memory, or from that of the result, comes back later,
            // perhaps together with others.
            REQUIRE((lost == 0 || (lost == 1 && outcome.ending == Ending::OutOfMemory) ||
                     (lost < 0 && lost + n_lost >= -1)));
            n_lost += lost;
            CHECK(outcome.ending != Ending::Other);
            if (outcome.ending == Ending::Success)
                CHECK(work.result() == expected);
            else
                work.check_failed();
        }
        CHECK(n_lost <= work.most_lost);
    }
}

}  // namespace seamflow::test
