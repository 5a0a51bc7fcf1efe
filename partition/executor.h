#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The body of a loop, for the indices begin to end - 1.
using RangeBody = std::function<void(Index begin, Index end)>;

/// Runs loops over 0 … n - 1: a caller with threads passes an executor that uses them. The executor runs the body for
/// ranges that together cover every index once, in any order and perhaps several at a time, and returns when all are
/// done. The result of a loop never depends on how it is divided.
using Executor = std::function<void(Index n, const RangeBody& body)>;

/// Runs the loop as one range in the thread of the caller.
inline void run_serially(Index n, const RangeBody& body)
{
    if (n > 0)
        body(0, n);
}

/// Runs body(i) for every i from 0 to n - 1.
template <class Body>
void for_each(const Executor& exec, Index n, Body&& body)
{
    exec(n, [&body](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            body(i);
    });
}

/// Number of indices per block in the functions below.
inline constexpr Index block_size = 4096;

/// Cuts 0 … n - 1 into blocks that depend on n alone and runs body(block, begin, end) for each.
template <class Body>
void for_each_block(const Executor& exec, Index n, Body&& body)
{
    const Index n_blocks = n / block_size + (n % block_size > 0 ? 1 : 0);
    for_each(exec, n_blocks, [&](Index block) {
        const Index begin = block * block_size;
        body(block, begin, begin + std::min(block_size, n - begin));
    });
}

/// Calls add(total, i) for each i from 0 to n - 1, beginning with an empty total for each block, and join(total, part)
/// to combine the totals of blocks, always in the same order.
/// @param empty the total of no indices: joining it must change nothing.
/// @returns the total of all indices.
template <class Total, class Add, class Join>
Total reduce(const Executor& exec, Index n, const Total& empty, Add&& add, Join&& join)
{
    std::vector<Total> of_block(n / block_size + 1, empty);
    for_each_block(exec, n, [&](Index block, Index begin, Index end) {
        Total total = empty;
        for (Index i = begin; i < end; ++i)
            add(total, i);
        of_block[block] = std::move(total);
    });
    Total total = empty;
    for (const Total& part : of_block)
        join(total, part);
    return total;
}

/// All i from 0 to n - 1 with holds(i), in ascending order.
template <class Predicate>
std::vector<Index> select(const Executor& exec, Index n, Predicate&& holds)
{
    return reduce(
        exec, n, std::vector<Index>{},
        [&](std::vector<Index>& selected, Index i) {
            if (holds(i))
                selected.push_back(i);
        },
        [](auto& selected, const auto& part) { selected.insert(selected.end(), part.begin(), part.end()); });
}

/// The sum of value(i) over 0 … n - 1. Always added up in the same order.
/// @param zero the sum of no values: each block begins with it, so that adding it must change nothing.
template <class Value, class Sum = double>
Sum sum(const Executor& exec, Index n, Value&& value, const Sum& zero = 0.0)
{
    return reduce(
        exec, n, zero, [&](Sum& total, Index i) { total += value(i); },
        [](Sum& total, const Sum& part) { total += part; });
}

/// The indices begin to end - 1.
struct IndexRange {
    Index begin = 0;
    Index end = 0;
};

/// 0 … n - 1 in at most 16 long ranges that depend only on n and n_values, for loops that make a table of n_values per
/// range. If n_values is at most n / 16, all tables together have n / 8 entries at most; otherwise there is a single
/// range.
inline std::vector<IndexRange> long_ranges(Index n, Index n_values)
{
    constexpr Index most = 16;
    constexpr Index shortest = 1 << 16;
    constexpr Index shortest_per_value = 16;
    const Index length =
        std::max({shortest, n / most + 1, n_values <= n / shortest_per_value ? shortest_per_value * n_values : n});
    std::vector<IndexRange> ranges;
    for (Index begin = 0; begin < n; begin = ranges.back().end)
        ranges.push_back({begin, begin + std::min(length, n - begin)});
    return ranges;
}

/// For each value 0 … n_values - 1, the sum of weight(i) over the indices i below n with this value.
template <class ValueOf, class Weight>
std::vector<std::int64_t> sums_by_value(const Executor& exec, Index n, Index n_values, ValueOf&& value_of,
                                        Weight&& weight)
{
    const std::vector<IndexRange> ranges = long_ranges(n, n_values);
    std::vector<std::vector<std::int64_t>> of_range(ranges.size());
    for_each(exec, static_cast<Index>(ranges.size()), [&](Index r) {
        std::vector<std::int64_t> sums(n_values, 0);
        for (Index i = ranges[r].begin; i < ranges[r].end; ++i)
            sums[value_of(i)] += weight(i);
        of_range[r] = std::move(sums);
    });
    std::vector<std::int64_t> sums(n_values, 0);
    for (const auto& part : of_range)
        std::transform(part.begin(), part.end(), sums.begin(), sums.begin(), std::plus<>());
    return sums;
}

}  // namespace seamflow
