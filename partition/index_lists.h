#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "partition/index.h"
#include "partition/large_arrays.h"

namespace seamflow {

/// Many lists in two flat arrays.
template <class Value>
struct Lists {
    /// Number of lists + 1; list i is values[offsets[i]] to values[offsets[i + 1] - 1].
    std::vector<Index> offsets{0};
    std::vector<Value> values;

    [[nodiscard]] Index size() const { return static_cast<Index>(offsets.size()) - 1; }

    [[nodiscard]] std::span<const Value> operator[](Index i) const
    {
        const std::size_t begin = usize(offsets[i]);
        return std::span<const Value>(values).subspan(begin, usize(offsets[i + 1]) - begin);
    }

    /// Ends a list whose entries have been pushed onto `values`.
    void close() { offsets.push_back(static_cast<Index>(values.size())); }

    /// Releases the memory reserved for further lists.
    void shrink_to_fit()
    {
        offsets.shrink_to_fit();
        values.shrink_to_fit();
    }
};

using IndexLists = Lists<Index>;

/// Lists whose arrays are owned elsewhere.
struct IndexListsView {
    std::span<const Index> offsets = {};
    std::span<const Index> values = {};

    IndexListsView() = default;
    IndexListsView(std::span<const Index> list_offsets, std::span<const Index> list_values)
        : offsets(list_offsets)
        , values(list_values)
    {
    }
    IndexListsView(const IndexLists& lists)
        : IndexListsView(lists.offsets, lists.values)
    {
    }

    [[nodiscard]] Index size() const { return offsets.empty() ? 0 : static_cast<Index>(offsets.size()) - 1; }
    [[nodiscard]] std::span<const Index> operator[](Index i) const
    {
        return values.subspan(usize(offsets[i]), usize(offsets[i + 1] - offsets[i]));
    }
};

/// Makes lists from entries, each list in the order of the entries: a counting sort.
/// @param for_each_entry called twice with a function that it calls with the list and the value of every entry, in the
///        same order both times.
template <class Value = Index, class ForEachEntry>
Lists<Value> make_lists(Index n_lists, ForEachEntry&& for_each_entry)
{
    Lists<Value> lists;
    auto& offsets = lists.offsets;
    // The beginning of each list is stored at the next index and advances to the list's end, which is the beginning of
    // the next list.
    offsets = large_vector<Index>(usize(n_lists) + 2);
    for_each_entry([&](Index list, const Value&) { ++offsets[list + 2]; });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    lists.values = large_vector<Value>(usize(offsets.back()));
    for_each_entry([&](Index list, const Value& value) { lists.values[offsets[list + 1]++] = value; });
    offsets.pop_back();
    return lists;
}

/// Sorts and removes duplicates.
template <class Value>
void sort_unique(std::vector<Value>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The index of a value among ascending values, or the index at which to insert it.
template <class Ascending, class Value>
Index place_in(const Ascending& ascending, const Value& value)
{
    return static_cast<Index>(std::ranges::lower_bound(ascending, value) - std::ranges::begin(ascending));
}

/// The index of a value among ascending values; -1 if it is not among them.
template <class Ascending, class Value>
Index find_in(const Ascending& ascending, const Value& value)
{
    const Index index = place_in(ascending, value);
    return std::cmp_less(index, std::size(ascending)) && ascending[index] == value ? index : -1;
}

/// The index of each number in an order of the numbers 0 to n - 1.
inline std::vector<Index> inverse(const std::vector<Index>& order)
{
    std::vector<Index> indices(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        indices[order[i]] = static_cast<Index>(i);
    return indices;
}

}  // namespace seamflow
