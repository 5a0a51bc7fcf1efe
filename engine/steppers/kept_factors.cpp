#include "engine/steppers/kept_factors.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// The sub-meshes by the size of their factors, the largest first.
std::vector<Index> largest_first(std::span<const std::size_t> factors)
{
    std::vector<Index> order(factors.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index s, Index t) { return factors[s] > factors[t]; });
    return order;
}

/// Keeps the first sub-meshes in the order and no others.
KeptFactors keep_first(std::span<const std::size_t> factors, std::span<const Index> order, Index n_whole,
                       Index n_places)
{
    KeptFactors kept;
    kept.whole.assign(factors.size(), 0);
    kept.n_whole = n_whole;
    for (const Index s : order.first(n_whole)) {
        kept.whole[s] = 1;
        kept.bytes += factors[s];
    }
    if (usize(n_whole) < order.size()) {
        kept.n_places = n_places;
        kept.bytes_per_place = factors[order[n_whole]];
    }
    return kept;
}

/// The most that fit with this number of places; -1 if not even zero do.
Index most_kept_within(std::span<const std::size_t> factors, std::span<const Index> order, Index n_places,
                       std::size_t limit)
{
    Index most = -1;
    std::size_t bytes = 0;
    for (std::size_t n_whole = 0; n_whole < order.size(); ++n_whole) {
        const std::size_t next = factors[order[n_whole]];
        if (bytes + usize(n_places) * next <= limit)
            most = static_cast<Index>(n_whole);
        bytes += next;
    }
    return most;
}

}  // namespace

KeptFactors choose_kept_factors(std::span<const std::size_t> factors, std::optional<std::size_t> limit, Index n_threads)
{
    const std::vector<Index> order = largest_first(factors);
    const auto n = static_cast<Index>(factors.size());
    const KeptFactors all = keep_first(factors, order, n, 0);
    if (!limit || all.bytes <= *limit)
        return all;
    Index n_whole = -1;
    Index n_places = 0;
    Index least_rounds = std::numeric_limits<Index>::max();
    // More places for factors made again leave less room to keep others: doubling them finds all relevant cases.
    for (Index places = 1;; places = std::min(2 * places, n_threads)) {
        const Index most = most_kept_within(factors, order, places, *limit);
        if (most < 0)
            break;
        if (const Index rounds = (n - most + places - 1) / places; rounds < least_rounds) {
            n_whole = most;
            n_places = places;
            least_rounds = rounds;
        }
        if (places == n_threads)
            break;
    }
    if (n_whole < 0)
        throw MemoryLimitError(
            Wording{"<memory_limit> is " + std::to_string(*limit) + " bytes, but one factorisation can take " +
                    std::to_string(factors[order.front()]) +
                    ": raise it, use more sub-meshes, or if the flow allows it sweeps (<approach sweep>)"});
    return keep_first(factors, order, n_whole, n_places);
}

}  // namespace seamflow
