#include "partition/decomposition/index_set.h"

#include <algorithm>
#include <bit>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Values are dense if there are at most this many indices per value between the first value and the last.
constexpr std::size_t most_indices_per_value = 256;

}  // namespace

IndexSet::IndexSet(std::span<const Index> values)
{
    if (values.empty())
        return;
    Index last = first_ = values.front();
    for (const Index value : values) {
        first_ = std::min(first_, value);
        last = std::max(last, value);
    }
    const std::size_t width = usize(last) - usize(first_) + 1;
    if (width <= most_indices_per_value * values.size())
        fill_window(values, width);
    else
        fill_slots(values);
}

/// Sets ascending_ and words_ for dense values.
/// @param width the number of indices from the first value to the last.
void IndexSet::fill_window(std::span<const Index> values, std::size_t width)
{
    words_.resize(width / bits_per_word + 1);
    for (const Index value : values) {
        const std::size_t offset = usize(value) - usize(first_);
        words_[offset / bits_per_word].bits |= std::uint64_t{1} << offset % bits_per_word;
    }
    Index n = 0;
    for (Word& word : words_) {
        word.before = n;
        n += count(word.bits);
    }
    ascending_.reserve(n);
    for (std::size_t word = 0; word < words_.size(); ++word)
        for (std::uint64_t left = words_[word].bits; left != 0; left &= left - 1)
            ascending_.push_back(first_ + static_cast<Index>(word * bits_per_word) + std::countr_zero(left));
}

/// Sets ascending_ and slots_ for scattered values.
void IndexSet::fill_slots(std::span<const Index> values)
{
    ascending_.assign(values.begin(), values.end());
    sort_unique(ascending_);
    // A single value is dense: here are at least two, hence four slots, and the shift is less than 64.
    slots_.assign(std::bit_ceil(2 * ascending_.size()), Slot{-1, -1});
    shift_ = 64 - std::countr_zero(slots_.size());
    for (std::size_t i = 0; i < ascending_.size(); ++i)
        slots_[slot_of(ascending_[i])] = {ascending_[i], static_cast<Index>(i)};
}

}  // namespace seamflow
