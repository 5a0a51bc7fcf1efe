#include <algorithm>
#include <cstddef>
#include <fstream>
#include <stop_token>
#include <vector>

#include <doctest/doctest.h>
#include <malloc.h>
#include <unistd.h>

#include "tests/support/outcome.h"
#include "tests/support/random_flows.h"
#include "tests/support/sanitizers.h"

using namespace seamflow;

namespace {

/// Sanitizers look for leaks themselves, and have an allocator of their own.
constexpr bool counts_memory = !test::under_sanitizers;
constexpr int n_rounds = test::under_sanitizers ? 2 : 21;
constexpr int flows_per_round = 500;
constexpr int rounds_to_warm_up = 1;

/// Bytes.
struct Memory {
    /// What has been asked for from the heap and not given back.
    std::size_t in_use;
    /// What the process takes of the machine's.
    std::size_t resident;
};

Memory memory_now()
{
    const struct mallinfo2 heap = mallinfo2();
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    return {heap.uordblks + heap.hblkhd, pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE))};
}

/// Small ones of every kind, some of which are refused or fail.
std::vector<test::RandomFlow> small_flows()
{
    std::vector<test::RandomFlow> flows;
    for (std::uint32_t seed = 1; static_cast<int>(flows.size()) < flows_per_round; ++seed) {
        test::RandomFlow flow = test::random_flow(seed);
        if (flow.input.mesh.n_vertices() > 100)
            continue;
        // An arena of more threads is oneTBB's until one of its workers has had the time to leave it.
        flow.options.resources.threads = static_cast<int>(seed % 2);
        flows.push_back(std::move(flow));
    }
    return flows;
}

/// How the flows of a round ended.
struct Ends {
    int succeeded = 0;
    int refused = 0;
    int stopped = 0;
};

Ends run_all(const std::vector<test::RandomFlow>& flows)
{
    Ends ends;
    for (std::size_t i = 0; i < flows.size(); ++i) {
        std::stop_source source;
        const double when = static_cast<double>(i % 10) / 10.0;
        const FlowControl control{.stop = source.get_token(), .on_progress = [&](const FlowProgress& progress) {
                                      if (i % 7 == 0 && progress.fraction >= when)
                                          source.request_stop();
                                  }};
        const test::Outcome outcome = test::outcome_of(flows[i].input.mesh, flows[i].options, control, i % 5 == 0);
        ++(outcome.refusal.empty() ? ends.succeeded : outcome.refusal == "Cancelled" ? ends.stopped : ends.refused);
    }
    return ends;
}

}  // namespace

TEST_CASE("ten thousand flows in a row, some of which are refused, fail or are stopped, take no more memory than some "
          "hundred")
{
    const std::vector<test::RandomFlow> flows = small_flows();
    Memory warm{};
    Memory now{};
    for (int round = 0; round < n_rounds; ++round) {
        const Ends ends = run_all(flows);
        CHECK(ends.succeeded > flows_per_round / 2);
        CHECK(ends.refused > 10);
        CHECK(ends.stopped > 10);
        now = memory_now();
        if (round == rounds_to_warm_up - 1)
            warm = now;
    }
    if (!counts_memory)
        return;
    CAPTURE(warm.in_use);
    CAPTURE(now.in_use);
    CAPTURE(warm.resident);
    CAPTURE(now.resident);
    // Below ten bytes a flow, or a page for every five.
    CHECK(now.in_use < warm.in_use + 100'000);
    CHECK(now.resident < warm.resident + (std::size_t{8} << 20U));
}
