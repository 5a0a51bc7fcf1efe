#pragma once

#include <limits>

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

inline Point centre_of(const Box& box)
{
    return 0.5 * box.low + 0.5 * box.high;
}

/// The squared distance of a point from a box, 0 within it.
inline double squared_distance(const Box& box, const Point& p)
{
    return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
}

}  // namespace seamflow
