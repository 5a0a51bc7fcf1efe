#include "solvers/interface/interface_sums.h"

#include <algorithm>

namespace seamflow {

SumTree::SumTree(InterfaceRanks& ranks)
    : ranks_(&ranks)
{
    constexpr Index several = -1;
    // Per row, the rank that has all the rows added up in it so far.
    std::vector<Index> holders = ranks.holders();
    const auto n = static_cast<Index>(holders.size());
    sent_rows_.resize(n > 0 ? usize(*std::ranges::max_element(holders)) + 1 : 0);
    const auto send = [&](Index row) {
        if (holders[row] != several)
            sent_rows_[holders[row]].push_back(row);
    };
    for (Index stride = 1; stride < n; stride *= 2)
        for (Index to = 0; to + stride < n; to += 2 * stride) {
            const Index from = to + stride;
            if (holders[to] == holders[from] && holders[to] != several) {
                if (holders[to] == ranks.own_rank())
                    own_.push_back({to, from});
                continue;
            }
            send(to);
            send(from);
            last_.push_back({to, from});
            holders[to] = several;
        }
    if (n > 0)
        send(0);
}

void SumTree::add(const std::vector<Addition>& additions, std::vector<double>& rows, std::size_t width)
{
    for (const auto& [to, from] : additions)
        for (std::size_t i = 0; i < width; ++i)
            rows[usize(to) * width + i] += rows[usize(from) * width + i];
}

std::vector<double> SumTree::add_up(std::vector<double>& rows, std::size_t width)
{
    if (rows.empty())
        return std::vector<double>(width, 0.0);
    const auto begin_of = [&](Index row) { return rows.begin() + static_cast<std::ptrdiff_t>(usize(row) * width); };
    add(own_, rows, width);
    std::vector<double> own;
    if (usize(ranks_->own_rank()) < sent_rows_.size())
        for (const Index row : sent_rows_[ranks_->own_rank()])
            own.insert(own.end(), begin_of(row), begin_of(row + 1));
    const InterfaceRanks::Numbers all = ranks_->gather(own);
    for (std::size_t rank = 0; rank < sent_rows_.size(); ++rank) {
        auto next = all[rank].begin();
        for (const Index row : sent_rows_[rank]) {
            std::copy_n(next, width, begin_of(row));
            next += static_cast<std::ptrdiff_t>(width);
        }
    }
    add(last_, rows, width);
    return {begin_of(0), begin_of(1)};
}

InterfaceSums::InterfaceSums(const InterfaceCopies& copies, InterfaceRanks& ranks)
    : copies_(&copies)
    , ranks_(&ranks)
    , tree_(ranks)
{
}

std::vector<Point> InterfaceSums::products(std::initializer_list<VectorPair> pairs, const Executor& exec)
{
    const std::size_t width = 3 * pairs.size();
    rows_.resize(usize(ranks_->n_sub_meshes()) * width);
    for_each(exec, copies_->n_sub_meshes(), [&](Index s) {
        if (!ranks_->is_own(s))
            return;
        double* row = rows_.data() + usize(ranks_->global_numbers()[s]) * width;
        for (const auto& [a, b] : pairs) {
            Point sum = Point::Zero();
            for (Index v = copies_->first_vertex[s]; v < copies_->first_vertex[s + 1]; ++v)
                sum += a.row(v).cwiseProduct(b.row(v));
            std::copy(sum.data(), sum.data() + 3, row);
            row += 3;
        }
    });
    const std::vector<double> sums = tree_.add_up(rows_, width);
    std::vector<Point> products;
    for (std::size_t i = 0; i < width; i += 3)
        products.emplace_back(sums[i], sums[i + 1], sums[i + 2]);
    return products;
}

}  // namespace seamflow
