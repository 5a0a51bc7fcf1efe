#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// A set of indices in ascending order, and where each stands in it, found in constant time.
class IndexSet {
  public:
    IndexSet() = default;

    /// @param values at least 0, in any order; repetitions are welcome.
    explicit IndexSet(std::span<const Index> values);

    [[nodiscard]] const std::vector<Index>& ascending() const { return ascending_; }

    /// Where a value stands, or -1.
    [[nodiscard]] Index operator[](Index value) const
    {
        if (!slots_.empty())
            return slots_[slot_of(value)].position;
        // What is below the first one is far beyond the last, too.
        const std::uint32_t offset = static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(first_);
        const std::size_t word = offset / bits_per_word;
        return word < words_.size() && (words_[word] >> offset % bits_per_word & 1) != 0 ? positions_[offset] : -1;
    }

  private:
    static constexpr std::uint32_t bits_per_word = 64;
    struct Slot {
        Index value;
        Index position;
    };

    void fill_window(std::span<const Index> values, std::size_t width);
    void fill_slots(std::span<const Index> values);

    /// Where `value` is, or the free slot for it. The upper bits of the product are those that all bits of the value
    /// have a say in: on a grid the indices of a part are a few runs that are a power of two apart.
    [[nodiscard]] std::size_t slot_of(Index value) const
    {
        std::size_t slot = static_cast<std::size_t>(static_cast<std::uint64_t>(value) * 0x9E3779B97F4A7C15U >> shift_);
        while (slots_[slot].value != value && slots_[slot].value >= 0)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::vector<Index> ascending_;
    /// Where the values lie together: a bit for each index from the first value to the last, and for those that have
    /// theirs set where they stand.
    Index first_ = 0;
    std::vector<std::uint64_t> words_;
    std::unique_ptr<Index[]> positions_;
    /// Where they are scattered: a table of a power of two slots, free ones with the value -1.
    std::vector<Slot> slots_;
    int shift_ = 0;
};

}  // namespace seamflow
