#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Points of several lists that are numbered together.
struct NumberedPoints {
    /// #V by 3, in the order of their numbers.
    Points points;
    /// The numbers of the points of all lists, one list after the other.
    std::unique_ptr<Index[]> numbers;
    /// For each list, the index of its first point in `numbers`; then the number of all points.
    std::vector<Index> begin;
};

/// Numbers the points of lists as PointNumbers would if it got one list after the other. Runs in parallel.
/// @tparam Real double or float.
/// @throws InputError if there are more than 2^31 - 1 points.
template <class Real>
NumberedPoints number_together(std::span<const std::vector<std::array<Real, 3>>> lists, const Executor& exec);

extern template NumberedPoints number_together(std::span<const std::vector<std::array<double, 3>>> lists,
                                               const Executor& exec);
extern template NumberedPoints number_together(std::span<const std::vector<std::array<float, 3>>> lists,
                                               const Executor& exec);

}  // namespace seamflow
