#pragma once

#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// What one sub-mesh sends to another: the rows `source` of the sender's positions become the rows `target` of the
/// receiver's. Both are local indices; entries correspond.
struct Transfer {
    Index from = -1;
    Index to = -1;
    std::vector<Index> source;
    std::vector<Index> target;
};

/// One row of a transfer.
struct TransferRow {
    Index from;
    Index source;
    Index target;
};

/// Everything that sub-mesh `to` receives: one transfer from each sender, in ascending order. Rows of the same sender
/// keep their order.
std::vector<Transfer> transfers_to(Index to, std::span<const TransferRow> rows);

}  // namespace seamflow
