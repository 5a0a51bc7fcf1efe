#include "partition/formats/vertex_welder.h"

#include <bit>
#include <cstdint>

namespace seamflow {

namespace {

/// Mixes the bits of the coordinates: multiplication carries them up, the shift brings them down again.
std::size_t hash(const std::array<double, 3>& point)
{
    std::uint64_t result = 0;
    for (const double x : point) {
        result = (result ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
        result ^= result >> 32U;
    }
    return static_cast<std::size_t>(result);
}

}  // namespace

/// The slot that holds the vertex at this point, or the free one where it belongs.
std::size_t VertexWelder::slot_of(const std::array<double, 3>& point) const
{
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(point) & mask;
    while (slots_[slot] >= 0 && points_[static_cast<std::size_t>(slots_[slot])] != point)
        slot = (slot + 1) & mask;
    return slot;
}

void VertexWelder::grow()
{
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t v = 0; v < points_.size(); ++v)
        slots_[slot_of(points_[v])] = static_cast<Index>(v);
}

Index VertexWelder::vertex(const std::array<double, 3>& point)
{
    const std::array<double, 3> key = {point[0] + 0.0, point[1] + 0.0, point[2] + 0.0};
    const std::size_t slot = slot_of(key);
    if (slots_[slot] >= 0)
        return slots_[slot];
    const auto result = static_cast<Index>(points_.size());
    builder_.add_vertex(point[0], point[1], point[2]);
    points_.push_back(key);
    slots_[slot] = result;
    if (2 * points_.size() > slots_.size())
        grow();
    return result;
}

}  // namespace seamflow
