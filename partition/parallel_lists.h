#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "partition/executor.h"

namespace seamflow {

/// Makes n lists in two flat arrays, several at a time.
/// @param fill called twice for each list: fill(i, list) replaces the content of `list` by list i.
/// @param offsets receives n + 1 numbers: list i is values[offsets[i]] to values[offsets[i + 1] - 1].
template <class Offset, class Fill>
void make_lists_in_parallel(const Executor& exec, Index n, Fill&& fill, std::vector<Offset>& offsets,
                            std::vector<Index>& values)
{
    const auto for_each_list = [&](auto&& use) {
        exec(n, [&](Index begin, Index end) {
            std::vector<Index> list;
            for (Index i = begin; i < end; ++i) {
                fill(i, list);
                use(i, list);
            }
        });
    };
    offsets.assign(usize(n) + 1, 0);
    for_each_list([&](Index i, const auto& list) { offsets[usize(i) + 1] = static_cast<Offset>(list.size()); });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    values.resize(offsets.back());
    for_each_list([&](Index i, const auto& list) {
        std::ranges::copy(list, values.begin() + static_cast<std::ptrdiff_t>(offsets[usize(i)]));
    });
}

}  // namespace seamflow
