#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Numbers points in order of first appearance; equal points get the same number. Positive and negative zero are equal;
/// the point keeps the sign that came first. NaN is equal to nothing.
class PointNumbers {
  public:
    using Place = std::array<double, 3>;

    PointNumbers()
        : slots_(1024, -1)
    {
    }

    /// Makes room for so many points.
    void reserve(std::size_t n);

    /// The number of a point, a new one if it has none.
    Index operator()(const Place& point);

    /// The number of a point, or -1.
    [[nodiscard]] Index find(const Place& point) const { return slots_[slot_of(point)]; }

    /// Equal for equal points.
    [[nodiscard]] static std::uint64_t hash_of(const Place& point);

    /// By their numbers.
    [[nodiscard]] const std::vector<Place>& points() const { return points_; }

    /// The same; no more points can be numbered.
    [[nodiscard]] std::vector<Place> take_points() { return std::move(points_); }

  private:
    [[nodiscard]] std::size_t slot_of(const Place& point) const;
    void resize(std::size_t n_slots);

    std::vector<Place> points_;
    /// A hash table with open addressing: numbers, or -1. Its length is a power of two.
    std::vector<Index> slots_;
};

}  // namespace seamflow
