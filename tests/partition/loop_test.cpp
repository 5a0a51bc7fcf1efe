#include <vector>

#include <doctest/doctest.h>

#include "partition/loop.h"

using namespace seamflow;

namespace {

/// Ranges of one index, the last one first.
void run_backwards(Index n, const LoopBody& body)
{
    for (Index i = n; i > 0; --i)
        body(i - 1, i);
}

}  // namespace

TEST_CASE("a loop comes by every index once")
{
    for (const Loop& loop : {Loop(run_serially), Loop(run_backwards)})
        for (const Index n : {0, 1, block_size - 1, block_size, 3 * block_size + 5}) {
            std::vector<int> visits(at(n), 0);
            for_each(loop, n, [&](Index i) { ++visits[at(i)]; });
            for_each_block(loop, n, [&](Index block, Index begin, Index end) {
                CHECK(begin == block * block_size);
                for (Index i = begin; i < end; ++i)
                    ++visits[at(i)];
            });
            CHECK(visits == std::vector<int>(at(n), 2));
        }
}

TEST_CASE("what is selected is in order, and sums have the same bits, however the loop is run")
{
    const Index n = 5 * block_size + 17;
    const auto third = [](Index i) { return i % 3 == 0; };
    const auto value = [](Index i) { return 1.0 / (1.0 + i); };
    const std::vector<Index> selected = select(run_serially, n, third);
    REQUIRE(selected.size() == at((n + 2) / 3));
    for (std::size_t i = 0; i < selected.size(); ++i)
        CHECK(selected[i] == 3 * static_cast<Index>(i));
    CHECK(select(run_backwards, n, third) == selected);
    CHECK(sum(run_backwards, n, value) == sum(run_serially, n, value));
    CHECK(sum(run_serially, 100, [](Index i) { return double(i); }) == 4950.0);
}
