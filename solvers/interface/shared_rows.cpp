#include "solvers/interface/shared_rows.h"

#include <algorithm>
#include <utility>

namespace seamflow {

SharedRows::SharedRows(InterfaceRanks& ranks, std::map<Index, Lists> with)
    : ranks_(&ranks)
{
    for (auto& [other, lists] : with) {
        others_.push_back(other);
        lists_.push_back(std::move(lists));
    }
}

void SharedRows::exchange(double* values, std::size_t width)
{
    InterfaceRanks::Numbers per_rank(others_.size());
    for (std::size_t p = 0; p < others_.size(); ++p)
        for (const Index row : lists_[p].given)
            per_rank[p].insert(per_rank[p].end(), values + usize(row) * width, values + usize(row + 1) * width);
    const InterfaceRanks::Numbers from_each = ranks_->exchange(others_, per_rank);
    for (std::size_t p = 0; p < others_.size(); ++p) {
        auto next = from_each[p].begin();
        for (const Index row : lists_[p].taken) {
            std::copy_n(next, width, values + usize(row) * width);
            next += static_cast<std::ptrdiff_t>(width);
        }
    }
}

}  // namespace seamflow
