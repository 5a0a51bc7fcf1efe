#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Numbers points in order of first appearance; equal points get the same number. Positive and negative zero are equal;
/// the point keeps the sign that came first. NaN is equal to nothing.
/// @tparam Real double or float.
template <class Real>
class BasicPointNumbers {
  public:
    /// The coordinates of a point.
    using Place = std::array<Real, 3>;

    BasicPointNumbers()
        : slots_(1024, -1)
    {
    }

    /// Reserves memory for n points.
    void reserve(std::size_t n);

    /// The number of a point; a new number if the point has none.
    Index operator()(const Place& point);

    /// The number of a point; -1 if it has none.
    [[nodiscard]] Index find(const Place& point) const { return slots_[slot_of(slots_, points_, point)]; }

    /// A hash, equal for equal points.
    [[nodiscard]] static std::uint64_t hash_of(const Place& point);

    /// The points, in the order of their numbers.
    [[nodiscard]] const std::vector<Place>& points() const { return points_; }

    /// Moves out the points; no more points can be numbered.
    [[nodiscard]] std::vector<Place> take_points() { return std::move(points_); }

    /// For each of the given points, the index of the first of them that equals it.
    [[nodiscard]] static std::vector<Index> first_equal(std::span<const Place> points);

  private:
    /// The slot with the number of a point, or the free slot for it.
    [[nodiscard]] static std::size_t slot_of(std::span<const Index> slots, std::span<const Place> points,
                                             const Place& point);
    void resize(std::size_t n_slots);

    std::vector<Place> points_;
    /// A hash table with open addressing: numbers, or -1. Its length is a power of two.
    std::vector<Index> slots_;
};

using PointNumbers = BasicPointNumbers<double>;

/// Mixes the bits of the coordinates: multiplication carries bits up, shifts carry them down again. Adding 0 turns -0
/// into 0. The constants are from SplitMix64, xxHash and MurmurHash3.
template <class Real>
std::uint64_t BasicPointNumbers<Real>::hash_of(const Place& point)
{
    using Bits = std::conditional_t<sizeof(Real) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
    const auto bits = [&](int c) { return std::uint64_t{std::bit_cast<Bits>(point[c] + Real{0})}; };
    std::uint64_t result =
        bits(0) * 0x9e3779b97f4a7c15U + bits(1) * 0xc2b2ae3d27d4eb4fU + bits(2) * 0x165667b19e3779f9U;
    result = (result ^ result >> 32U) * 0xff51afd7ed558ccdU;
    return result ^ result >> 32U;
}

template <class Real>
std::size_t BasicPointNumbers<Real>::slot_of(std::span<const Index> slots, std::span<const Place> points,
                                             const Place& point)
{
    const std::size_t mask = slots.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash_of(point)) & mask;
    while (slots[slot] >= 0 && points[usize(slots[slot])] != point)
        slot = (slot + 1) & mask;
    return slot;
}

/// Replaces the hash table by one of n_slots slots and enters all points.
template <class Real>
void BasicPointNumbers<Real>::resize(std::size_t n_slots)
{
    slots_.assign(n_slots, -1);
    for (std::size_t v = 0; v < points_.size(); ++v)
        slots_[slot_of(slots_, points_, points_[v])] = static_cast<Index>(v);
}

template <class Real>
void BasicPointNumbers<Real>::reserve(std::size_t n)
{
    points_.reserve(n);
    if (2 * n > slots_.size())
        resize(std::bit_ceil(2 * n));
}

template <class Real>
Index BasicPointNumbers<Real>::operator()(const Place& point)
{
    const std::size_t slot = slot_of(slots_, points_, point);
    if (slots_[slot] >= 0)
        return slots_[slot];
    const auto number = static_cast<Index>(points_.size());
    points_.push_back(point);
    slots_[slot] = number;
    if (2 * points_.size() > slots_.size())
        resize(2 * slots_.size());
    return number;
}

template <class Real>
std::vector<Index> BasicPointNumbers<Real>::first_equal(std::span<const Place> points)
{
    std::vector<Index> slots(std::bit_ceil(2 * points.size() + 1), -1);
    std::vector<Index> first(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        Index& number = slots[slot_of(slots, points, points[i])];
        if (number < 0)
            number = static_cast<Index>(i);
        first[i] = number;
    }
    return first;
}

}  // namespace seamflow
