#include <algorithm>
#include <atomic>
#include <cstdint>
#include <new>

#include <doctest/doctest.h>

#include "engine/memory/factor_pool.h"
#include "engine/tasks/parallel_loop.h"
#include "engine/tasks/workers.h"

using namespace seamflow;

TEST_CASE("a pool grows to what is taken at once, and no further")
{
    FactorPool pool;
    pool.use_blocks_of(100);
    CHECK(pool.bytes() == 0);
    for (int round = 0; round < 3; ++round) {
        std::vector<std::span<std::byte>> taken;
        for (const std::size_t bytes : {100U, 1U, 37U, 100U}) {
            taken.push_back(pool.take(bytes));
            CHECK(taken.back().size() >= bytes);
        }
        for (const auto& memory : taken)
            pool.give_back(memory);
        CHECK(pool.bytes() == 400);
    }
}

TEST_CASE("blocks that are taken at the same time are apart and fit for doubles, and the last one back is the next")
{
    FactorPool pool;
    pool.use_blocks_of(64);
    std::vector<std::span<std::byte>> taken;
    for (int i = 0; i < 10; ++i) {
        taken.push_back(pool.take(64));
        CHECK(reinterpret_cast<std::uintptr_t>(taken.back().data()) % alignof(double) == 0);
    }
    std::sort(taken.begin(), taken.end(), [](const auto& a, const auto& b) { return a.data() < b.data(); });
    for (std::size_t i = 1; i < taken.size(); ++i)
        CHECK(taken[i - 1].data() + 64 <= taken[i].data());
    pool.give_back(taken[3]);
    pool.give_back(taken[7]);
    CHECK(pool.take(8).data() == taken[7].data());
    CHECK(pool.take(8).data() == taken[3].data());
}

TEST_CASE("threads that take and give back at the same time never have the same block")
{
    constexpr int threads = 4;
    FactorPool pool;
    pool.use_blocks_of(sizeof(int));
    std::atomic<int> n_shared = 0;
    Workers(threads).execute([&] {
        for_each(run_in_parallel, 20'000, [&](Index i) {
            const auto memory = pool.take(sizeof(int));
            auto* const number = new (memory.data()) volatile int(i);
            n_shared += *number == i ? 0 : 1;
            pool.give_back(memory);
        });
    });
    CHECK(n_shared == 0);
    CHECK(pool.bytes() <= threads * sizeof(int));
}
