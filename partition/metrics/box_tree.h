#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "partition/index.h"
#include "partition/vector_area.h"

namespace seamflow {

/// An axis-aligned box, borders included; empty at first.
struct Box {
    Point low = Point::Constant(std::numeric_limits<double>::infinity());
    Point high = Point::Constant(-std::numeric_limits<double>::infinity());

    void add(const Point& p)
    {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }

    void add(const Box& box)
    {
        low = low.cwiseMin(box.low);
        high = high.cwiseMax(box.high);
    }

    [[nodiscard]] bool meets(const Box& other) const
    {
        return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
               other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
    }
};

/// The centre of a box in 2²¹ steps along each side of another, the bits of all three interleaved: numbers that are
/// close belong to boxes that are close, too (Morton, A Computer Oriented Geodetic Data Base, 1966).
inline std::uint64_t place_on_curve(const Box& box, const Box& whole)
{
    constexpr int n_bits = 21;
    std::uint64_t place = 0;
    for (int c = 0; c < 3; ++c) {
        // Halved, because sums of large numbers overflow.
        const double side = 0.5 * whole.high[c] - 0.5 * whole.low[c];
        const double offset = 0.5 * (0.5 * box.low[c] + 0.5 * box.high[c] - whole.low[c]);
        const double part = side > 0.0 ? std::clamp(offset / side, 0.0, 1.0) : 0.0;
        const auto step = static_cast<std::uint64_t>(part * ((1U << n_bits) - 1U));
        for (int bit = 0; bit < n_bits; ++bit)
            place |= (step >> bit & 1U) << (3 * bit + c);
    }
    return place;
}

/// A binary tree over boxes in an order that keeps neighbours together. Node k of a level spans the nodes 2k and 2k + 1
/// of the level below, as far as these exist.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Box> leaves)
    {
        levels_.push_back(std::move(leaves));
        while (levels_.back().size() > 1)
            levels_.push_back(parents_of(levels_.back()));
    }

    [[nodiscard]] Index size() const { return static_cast<Index>(levels_.front().size()); }
    [[nodiscard]] const Box& leaf(Index i) const { return levels_.front()[i]; }

    /// Calls visit(i) for the leaves i ≥ first that meet the box, ascending.
    template <class Visit>
    void for_each_meeting(const Box& box, Index first, Visit&& visit) const
    {
        struct Node {
            int level;
            Index number;
        };
        std::array<Node, 64> waiting;
        std::size_t n_waiting = 0;
        if (size() > 0)
            waiting[n_waiting++] = {static_cast<int>(levels_.size()) - 1, 0};
        while (n_waiting > 0) {
            const auto [level, k] = waiting[--n_waiting];
            if ((k + 1) * (std::size_t{1} << level) <= at(first) || !levels_[level][k].meets(box))
                continue;
            if (level == 0) {
                visit(k);
                continue;
            }
            if (at(2 * k + 1) < levels_[level - 1].size())
                waiting[n_waiting++] = {level - 1, 2 * k + 1};
            waiting[n_waiting++] = {level - 1, 2 * k};
        }
    }

  private:
    static std::vector<Box> parents_of(const std::vector<Box>& nodes)
    {
        std::vector<Box> parents((nodes.size() + 1) / 2);
        for (std::size_t k = 0; k < nodes.size(); ++k)
            parents[k / 2].add(nodes[k]);
        return parents;
    }

    /// The leaves first, the root last.
    std::vector<std::vector<Box>> levels_;
};

}  // namespace seamflow
