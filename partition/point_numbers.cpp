#include "partition/point_numbers.h"

#include <bit>
#include <cstdint>

namespace seamflow {

namespace {

/// Mixes the bits of the coordinates, zeros positive: multiplication carries them up, the shift brings them down again.
std::size_t hash_of(const PointNumbers::Place& point)
{
    std::uint64_t result = 0;
    for (const double x : point) {
        result = (result ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15U;
        result ^= result >> 32U;
    }
    return static_cast<std::size_t>(result);
}

}  // namespace

/// The slot that holds the number of this point, or the free one where it belongs.
std::size_t PointNumbers::slot_of(const Place& point) const
{
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(point) & mask;
    while (slots_[slot] >= 0 && points_[at(slots_[slot])] != point)
        slot = (slot + 1) & mask;
    return slot;
}

void PointNumbers::grow()
{
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t v = 0; v < points_.size(); ++v)
        slots_[slot_of(points_[v])] = static_cast<Index>(v);
}

Index PointNumbers::operator()(const Place& point)
{
    const std::size_t slot = slot_of(point);
    if (slots_[slot] >= 0)
        return slots_[slot];
    const auto number = static_cast<Index>(points_.size());
    points_.push_back(point);
    slots_[slot] = number;
    if (2 * points_.size() > slots_.size())
        grow();
    return number;
}

}  // namespace seamflow
