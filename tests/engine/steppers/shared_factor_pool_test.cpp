#include <atomic>
#include <new>

#include <doctest/doctest.h>

#include "engine/steppers/shared_factor_pool.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/workers.h"

using namespace seamflow;

TEST_CASE("threads that take and give back at the same time never have the same block")
{
    constexpr int threads = 4;
    SharedFactorPool pool(sizeof(int));
    std::atomic<int> n_shared = 0;
    Workers(threads).execute([&] {
        for_each(run_in_parallel, 20'000, [&](Index i) {
            const auto memory = take_numbers<std::byte>(pool, sizeof(int));
            auto* const number = new (memory.get()) volatile int(i);
            n_shared += *number == i ? 0 : 1;
        });
    });
    CHECK(n_shared == 0);
    CHECK(pool.bytes() <= threads * sizeof(int));
}
