#include <algorithm>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "partition/decomposition/index_set.h"

using namespace seamflow;

namespace {

/// The set must have these values and no others, and know where each stands.
void check_set(const IndexSet& set, std::vector<Index> values, Index beyond)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    CHECK(set.ascending() == values);
    std::size_t position = 0;
    Index n_wrong = 0;
    for (Index value = values.empty() ? 0 : std::max(values.front() - 100, 0); value < beyond; ++value) {
        const bool is_in = position < values.size() && values[position] == value;
        n_wrong += set[value] != (is_in ? static_cast<Index>(position) : -1) ? 1 : 0;
        position += is_in ? 1 : 0;
    }
    CHECK(n_wrong == 0);
}

}  // namespace

TEST_CASE("a set knows where each index stands, whether they lie together or are scattered")
{
    std::mt19937 random(3);
    for (const Index range : {1, 63, 64, 65, 500, 5000, 3'000'000})
        for (const Index first : {0, 1, 1000, 64'000}) {
            CAPTURE(range);
            CAPTURE(first);
            std::vector<Index> values;
            for (int i = 0; i < 1000; ++i)
                values.push_back(first + static_cast<Index>(random() % static_cast<unsigned>(range)));
            check_set(IndexSet(values), values, first + range + 100);
        }
}

TEST_CASE("a set knows the indices of a part of a grid whose rows are a power of two apart")
{
    std::vector<Index> values;
    for (Index row = 0; row < 50; ++row)
        for (Index column = 0; column < 50; ++column)
            values.push_back(65536 * row + column);
    check_set(IndexSet(values), values, 65536 * 50 + 100);
}

TEST_CASE("sets of no index, of one, of the last ones and of two far apart")
{
    check_set(IndexSet(), {}, 100);
    check_set(IndexSet(std::vector<Index>{}), {}, 100);
    check_set(IndexSet(std::vector<Index>{7, 7, 7}), {7}, 100);
    constexpr Index last = std::numeric_limits<Index>::max();
    const IndexSet ends(std::vector<Index>{last, 0, last - 1});
    CHECK(ends.ascending() == std::vector<Index>{0, last - 1, last});
    CHECK(ends[0] == 0);
    CHECK(ends[last] == 2);
    CHECK(ends[1] == -1);
    const IndexSet top(std::vector<Index>{last, last - 3});
    CHECK(top[last] == 1);
    CHECK(top[last - 1] == -1);
    CHECK(top[0] == -1);
}
