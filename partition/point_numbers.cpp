#include "partition/point_numbers.h"

#include <bit>

namespace seamflow {

/// Mixes the bits of the coordinates, zeros positive: multiplication carries them up, the shifts bring them down again.
std::uint64_t PointNumbers::hash_of(const Place& point)
{
    const auto bits = [&](int c) { return std::bit_cast<std::uint64_t>(point[c] + 0.0); };
    std::uint64_t result =
        bits(0) * 0x9e3779b97f4a7c15U + bits(1) * 0xc2b2ae3d27d4eb4fU + bits(2) * 0x165667b19e3779f9U;
    result = (result ^ result >> 32U) * 0xff51afd7ed558ccdU;
    return result ^ result >> 32U;
}

/// The slot that holds the number of this point, or the free one where it belongs.
std::size_t PointNumbers::slot_of(const Place& point) const
{
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash_of(point)) & mask;
    while (slots_[slot] >= 0 && points_[at(slots_[slot])] != point)
        slot = (slot + 1) & mask;
    return slot;
}

void PointNumbers::resize(std::size_t n_slots)
{
    slots_.assign(n_slots, -1);
    for (std::size_t v = 0; v < points_.size(); ++v)
        slots_[slot_of(points_[v])] = static_cast<Index>(v);
}

void PointNumbers::reserve(std::size_t n)
{
    points_.reserve(n);
    if (2 * n > slots_.size())
        resize(std::bit_ceil(2 * n));
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
        resize(2 * slots_.size());
    return number;
}

}  // namespace seamflow
