#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/backwards.h"

using namespace seamflow;
using test::run_backwards;

TEST_CASE("a loop comes by every index once")
{
    for (const Executor& exec : {Executor(run_serially), Executor(run_backwards)})
        for (const Index n : {0, 1, block_size - 1, block_size, 3 * block_size + 5}) {
            std::vector<int> visits(n, 0);
            for_each(exec, n, [&](Index i) { ++visits[i]; });
            for_each_block(exec, n, [&](Index block, Index begin, Index end) {
                CHECK(begin == block * block_size);
                for (Index i = begin; i < end; ++i)
                    ++visits[i];
            });
            CHECK(visits == std::vector<int>(n, 2));
        }
}

TEST_CASE("what is selected is in order, and sums have the same bits, however the loop is run")
{
    const Index n = 5 * block_size + 17;
    const auto third = [](Index i) { return i % 3 == 0; };
    const auto value = [](Index i) { return 1.0 / (1.0 + i); };
    const std::vector<Index> selected = select(run_serially, n, third);
    REQUIRE(selected.size() == usize((n + 2) / 3));
    for (std::size_t i = 0; i < selected.size(); ++i)
        CHECK(selected[i] == 3 * static_cast<Index>(i));
    CHECK(select(run_backwards, n, third) == selected);
    CHECK(sum(run_backwards, n, value) == sum(run_serially, n, value));
    CHECK(sum(run_serially, 100, [](Index i) { return double(i); }) == 4950.0);
}

TEST_CASE("long ranges have every index once, are few, and none short but the last")
{
    for (const Index n : {0, 1, 65536, 65537, 1'000'000, 16 * 65536, 50'000'000, 2'147'483'647}) {
        const std::vector<IndexRange> ranges = long_ranges(n, 100);
        Index end = 0;
        for (const IndexRange& range : ranges) {
            CHECK(range.begin == end);
            end = range.end;
            CHECK((range.end - range.begin >= 65536 || range.end == n));
        }
        CHECK(end == n);
        CHECK(ranges.size() <= 16);
        CHECK(ranges.size() >= std::min<std::size_t>(usize(n) / 65536, 15));
    }
    CHECK(long_ranges(10'000'000, 100'000).size() == 7);
    CHECK(long_ranges(10'000'000, 1'000'000).size() == 1);
    CHECK(long_ranges(10'000'000, 2'147'483'647).size() == 1);
}

TEST_CASE("weights are added up by value, however the loop is run")
{
    const Index n = 200'000;
    const auto value = [](Index i) { return i % 7; };
    const auto weight = [](Index i) { return i; };
    std::vector<std::int64_t> expected(9, 0);
    for (Index i = 0; i < n; ++i)
        expected[value(i)] += i;
    CHECK(sums_by_value(run_serially, n, 9, value, weight) == expected);
    CHECK(sums_by_value(run_backwards, n, 9, value, weight) == expected);
    CHECK(sums_by_value(run_serially, 0, 2, value, weight) == std::vector<std::int64_t>{0, 0});
}
