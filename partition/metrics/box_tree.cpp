#include "partition/metrics/box_tree.h"

#include <bit>
#include <numeric>

namespace seamflow {

namespace {

/// Moves the n_lower points that are lowest along the longest side of their bounding box to the front of `order`.
void divide(std::span<Index> order, std::size_t n_lower, std::span<const Point> points)
{
    Box box;
    for (const Index i : order)
        box.add(points[i]);
    Eigen::Index axis = 0;
    // Lengths are halved, because differences of large numbers overflow.
    Point(0.5 * box.high - 0.5 * box.low).maxCoeff(&axis);
    std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(n_lower), {},
                             [&](Index i) { return points[i][axis]; });
}

}  // namespace

std::vector<Index> order_of_neighbours(std::span<const Point> points, const Executor& exec)
{
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t length = std::bit_ceil(points.size()); length > 1; length /= 2) {
        const std::size_t n_lower = length / 2;
        // Only nodes of more than n_lower points are divided.
        for_each(exec, static_cast<Index>((points.size() + n_lower - 1) / length), [&](Index k) {
            const std::span rest = std::span(order).subspan(usize(k) * length);
            divide(rest.first(std::min(rest.size(), length)), n_lower, points);
        });
    }
    return order;
}

}  // namespace seamflow
