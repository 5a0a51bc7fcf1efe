#pragma once

#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Many lists of indices in two flat arrays.
struct IndexLists {
    /// Number of lists + 1; list i is values[offsets[i]] to values[offsets[i + 1] - 1].
    std::vector<Index> offsets{0};
    std::vector<Index> values;

    [[nodiscard]] Index size() const { return static_cast<Index>(offsets.size()) - 1; }

    [[nodiscard]] std::span<const Index> operator[](Index i) const
    {
        const std::size_t begin = at(offsets[i]);
        return std::span<const Index>(values).subspan(begin, at(offsets[i + 1]) - begin);
    }

    /// Appends a list that has been pushed onto `values` entry by entry.
    void close() { offsets.push_back(static_cast<Index>(values.size())); }

    /// Gives back the memory for lists that do not come.
    void shrink_to_fit()
    {
        offsets.shrink_to_fit();
        values.shrink_to_fit();
    }
};

}  // namespace seamflow
