#include <algorithm>
#include <random>

#include <doctest/doctest.h>

#include "partition/decomposition/position_table.h"
#include "partition/decomposition/transfers.h"

using namespace seamflow;

TEST_CASE("rows of one sender make one transfer, in their order; senders ascend")
{
    const std::vector<TransferRow> rows{{7, 1, 10}, {2, 5, 11}, {7, 0, 12}, {2, 4, 3}, {7, 9, 2}};
    const auto transfers = transfers_to(4, rows);
    REQUIRE(transfers.size() == 2);
    CHECK(transfers[0].from == 2);
    CHECK(transfers[0].to == 4);
    CHECK(transfers[0].source == std::vector<Index>{5, 4});
    CHECK(transfers[0].target == std::vector<Index>{11, 3});
    CHECK(transfers[1].from == 7);
    CHECK(transfers[1].to == 4);
    CHECK(transfers[1].source == std::vector<Index>{1, 0, 9});
    CHECK(transfers[1].target == std::vector<Index>{10, 12, 2});
    CHECK(transfers_to(4, {}).empty());
}

TEST_CASE("a table knows where each index of a list is, however few were expected")
{
    std::mt19937 random(3);
    std::vector<Index> values;
    PositionTable table(1);
    for (int i = 0; i < 1000; ++i) {
        const auto value = static_cast<Index>(random() % 5000);
        const bool is_new = std::find(values.begin(), values.end(), value) == values.end();
        CHECK(table.insert(value) == is_new);
        if (is_new)
            values.push_back(value);
    }
    table.set_positions(values, 20);
    for (Index value = 0; value < 5000; ++value) {
        const auto found = std::find(values.begin(), values.end(), value);
        CHECK(table[value] == (found == values.end() ? -1 : 20 + static_cast<Index>(found - values.begin())));
    }
}

TEST_CASE("a table knows the indices of a part of a grid whose rows are a power of two apart")
{
    std::vector<Index> values;
    for (Index row = 0; row < 50; ++row)
        for (Index column = 0; column < 50; ++column)
            values.push_back(65536 * row + column);
    PositionTable table(values.size());
    table.insert_list(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        CHECK(table[values[i]] == static_cast<Index>(i));
    CHECK(table[65536 * 50] == -1);
    CHECK(table[50] == -1);
}

TEST_CASE("a table appends what it does not have yet, and tells where everything is")
{
    std::mt19937 random(4);
    std::vector<Index> list;
    PositionTable table(1);
    for (int i = 0; i < 1000; ++i) {
        const auto value = static_cast<Index>(random() % 300);
        const Index position = table.position_or_append(value, list);
        REQUIRE(at(position) < list.size());
        CHECK(list[at(position)] == value);
    }
    std::sort(list.begin(), list.end());
    CHECK(std::adjacent_find(list.begin(), list.end()) == list.end());
}
