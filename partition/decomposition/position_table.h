#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Where indices stand in a list, found in constant time.
class PositionTable {
  public:
    /// @param expected about how many there will be; it grows if there are more.
    explicit PositionTable(std::size_t expected = 0)
        : slots_(std::bit_ceil(2 * expected + 2), Slot{-1, -1})
    {
    }

    /// Takes in an index whose position is set later.
    /// @param value at least 0. @returns whether it was not in the table.
    bool insert(Index value)
    {
        if (slots_[slot_of(value)].value >= 0)
            return false;
        if (2 * (n_values_ + 1) > slots_.size())
            grow();
        slots_[slot_of(value)].value = value;
        ++n_values_;
        return true;
    }

    /// The position of an index; where it is new, it is appended to the list, and that is its position.
    Index position_or_append(Index value, std::vector<Index>& list)
    {
        std::size_t slot = slot_of(value);
        if (slots_[slot].value < 0) {
            if (2 * (n_values_ + 1) > slots_.size()) {
                grow();
                slot = slot_of(value);
            }
            slots_[slot] = {value, static_cast<Index>(list.size())};
            ++n_values_;
            list.push_back(value);
        }
        return slots_[slot].position;
    }

    /// Of indices that are in the table, in the order given.
    void set_positions(std::span<const Index> values, Index first = 0)
    {
        for (std::size_t i = 0; i < values.size(); ++i)
            slots_[slot_of(values[i])].position = first + static_cast<Index>(i);
    }

    /// Takes in a list.
    void insert_list(std::span<const Index> values)
    {
        for (const Index value : values)
            insert(value);
        set_positions(values);
    }

    /// -1 for what is not in the table.
    [[nodiscard]] Index operator[](Index value) const { return slots_[slot_of(value)].position; }

  private:
    struct Slot {
        Index value;
        Index position;
    };

    /// Where `value` is, or the free slot for it. The upper bits of the product are those that all bits of the value
    /// have a say in: on a grid the indices of a part are a few runs that are a power of two apart.
    [[nodiscard]] std::size_t slot_of(Index value) const
    {
        std::size_t slot = static_cast<std::size_t>(static_cast<std::uint64_t>(value) * 0x9E3779B97F4A7C15U >> shift_);
        while (slots_[slot].value != value && slots_[slot].value >= 0)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    void grow()
    {
        --shift_;
        for (const Slot& slot : std::exchange(slots_, std::vector<Slot>(2 * slots_.size(), Slot{-1, -1})))
            if (slot.value >= 0)
                slots_[slot_of(slot.value)] = slot;
    }

    /// A power of two.
    std::vector<Slot> slots_;
    /// 64 less the number of bits of a slot's number.
    int shift_ = 64 - std::countr_zero(slots_.size());
    std::size_t n_values_ = 0;
};

}  // namespace seamflow
