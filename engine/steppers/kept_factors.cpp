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

/// Keeps the factors of the first n_whole sub-meshes in the order and no others.
KeptFactors keep_first(std::span<const std::size_t> factors, std::span<const Index> order, Index n_whole, Index n_slots)
{
    KeptFactors kept;
    kept.whole.assign(factors.size(), 0);
    kept.n_whole = n_whole;
    for (const Index s : order.first(n_whole)) {
        kept.whole[s] = 1;
        kept.bytes += factors[s];
    }
    if (usize(n_whole) < order.size()) {
        kept.n_slots = n_slots;
        kept.bytes_per_slot = factors[order[n_whole]];
    }
    return kept;
}

/// The largest number of whole factors, but not all, that fits into the limit together with this number of slots; -1 if
/// the slots alone do not. A slot has the size of the largest factor that is not kept.
Index most_kept_within(std::span<const std::size_t> factors, std::span<const Index> order, Index n_slots,
                       std::size_t limit)
{
    Index most = -1;
    std::size_t bytes = 0;
    for (std::size_t n_whole = 0; n_whole < order.size(); ++n_whole) {
        const std::size_t next = factors[order[n_whole]];
        if (bytes + usize(n_slots) * next <= limit)
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
    Index n_slots = 0;
    Index least_rounds = std::numeric_limits<Index>::max();
    // More slots for recomputed factors leave less room to keep factors. Only powers of 2 and n_threads are tried: that
    // is near enough to the best number.
    for (Index slots = 1;; slots = std::min(2 * slots, n_threads)) {
        const Index most = most_kept_within(factors, order, slots, *limit);
        if (most < 0)
            break;
        if (const Index rounds = (n - most + slots - 1) / slots; rounds < least_rounds) {
            n_whole = most;
            n_slots = slots;
            least_rounds = rounds;
        }
        if (slots == n_threads)
            break;
    }
    if (n_whole < 0)
        throw MemoryLimitError(
            Wording{"<memory_limit> is " + std::to_string(*limit) + " bytes, but one factorisation can take " +
                    std::to_string(factors[order.front()]) +
                    ": raise it, use more sub-meshes, or if the flow allows it sweeps (<approach sweep>)"});
    return keep_first(factors, order, n_whole, n_slots);
}

}  // namespace seamflow
