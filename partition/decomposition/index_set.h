#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// A set of indices in ascending order, with constant-time lookup of their positions.
class IndexSet {
  public:
    IndexSet() = default;

    /// @param values at least 0, in any order; repetitions are allowed.
    explicit IndexSet(std::span<const Index> values);

    /// The values, each once, ascending.
    [[nodiscard]] const std::vector<Index>& ascending() const { return ascending_; }

    /// The position of a value in ascending(), or -1.
    [[nodiscard]] Index operator[](Index value) const
    {
        if (!slots_.empty())
            return slots_[slot_of(value)].position;
        // For values below the first, the difference wraps around to numbers beyond the last.
        const std::uint32_t offset = static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(first_);
        if (offset / bits_per_word >= words_.size())
            return -1;
        const Word& word = words_[offset / bits_per_word];
        const std::uint64_t bit = std::uint64_t{1} << offset % bits_per_word;
        return (word.bits & bit) != 0 ? word.before + count(word.bits & (bit - 1)) : -1;
    }

  private:
    static constexpr std::uint32_t bits_per_word = 64;
    struct Word {
        std::uint64_t bits = 0;
        /// The number of bits that are set in earlier words.
        Index before = 0;
    };
    struct Slot {
        Index value;
        Index position;
    };

    /// The number of bits that are set; std::popcount is a call where the processor may lack an instruction for it.
    static Index count(std::uint64_t bits)
    {
        bits -= bits >> 1 & 0x5555555555555555U;
        bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);
        return static_cast<Index>(((bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0FU) * 0x0101010101010101U >> 56);
    }

    void fill_window(std::span<const Index> values, std::size_t width);
    void fill_slots(std::span<const Index> values);

    /// The slot of `value`, or the free slot for it. The upper bits of the product depend on all bits of the value: on
    /// a grid, the indices of a part are a few runs whose distances are powers of two.
    [[nodiscard]] std::size_t slot_of(Index value) const
    {
        std::size_t slot = static_cast<std::size_t>(static_cast<std::uint64_t>(value) * 0x9E3779B97F4A7C15U >> shift_);
        while (slots_[slot].value != value && slots_[slot].value >= 0)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::vector<Index> ascending_;
    /// Dense values: a bit for each index from the first value to the last.
    Index first_ = 0;
    std::vector<Word> words_;
    /// Scattered values: a table of a power of two slots; free slots have the value -1.
    std::vector<Slot> slots_;
    int shift_ = 0;
};

}  // namespace seamflow
