#include <doctest/doctest.h>

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
