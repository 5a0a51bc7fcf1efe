#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/workers.h"

using namespace seamflow;

TEST_CASE("a parallel loop has every index once, and is over when it returns")
{
    for (const int threads : {1, 2, 5})
        Workers(threads).execute([&] {
            for (const Index n : {0, 1, 2, 1000}) {
                std::vector<int> times(n, 0);
                for_each(run_in_parallel, n, [&](Index i) { ++times[i]; });
                CHECK(times == std::vector<int>(n, 1));
            }
        });
}

TEST_CASE("two pieces of work are both done, whatever the number of threads")
{
    for (const int threads : {1, 2, 5})
        Workers(threads).execute([&] {
            int one = 0;
            int other = 0;
            run_both([&] { one = 1; }, [&] { other = 2; });
            CHECK(one + other == 3);
        });
}

TEST_CASE("what a body throws comes out of the loop")
{
    for (const int threads : {1, 4})
        Workers(threads).execute([&] {
            const auto body = [](Index i) {
                if (i == 500)
                    throw std::runtime_error("five hundred");
            };
            CHECK_THROWS_WITH(for_each(run_in_parallel, 1000, body), "five hundred");
            CHECK_THROWS_WITH(run_both([&] { body(500); }, [&] { body(1); }), "five hundred");
        });
}
