#include "partition/decomposition/transfers.h"

#include "partition/decomposition/local_mesh.h"

namespace seamflow {

std::vector<Transfer> transfers_to(Index to, std::span<const TransferRow> rows)
{
    std::vector<Index> senders;
    for (const TransferRow& row : rows)
        if (senders.empty() || senders.back() != row.from)
            senders.push_back(row.from);
    sort_unique(senders);
    std::vector<Index> transfer_of(rows.size());
    std::vector<std::size_t> counts(senders.size(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        transfer_of[i] = position_in(senders, rows[i].from);
        ++counts[transfer_of[i]];
    }
    std::vector<Transfer> transfers(senders.size());
    for (std::size_t k = 0; k < senders.size(); ++k) {
        transfers[k].from = senders[k];
        transfers[k].to = to;
        transfers[k].source.reserve(counts[k]);
        transfers[k].target.reserve(counts[k]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Transfer& transfer = transfers[transfer_of[i]];
        transfer.source.push_back(rows[i].source);
        transfer.target.push_back(rows[i].target);
    }
    return transfers;
}

}  // namespace seamflow
