#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/point_numbers.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Points of several lists that are numbered together.
struct NumberedPoints {
    /// #V by 3, by their numbers.
    Points points;
    /// The numbers of the points of all lists, one list after the other.
    std::vector<Index> numbers;
    /// For each list, where its points begin among those; then their count.
    std::vector<Index> begin;
};

/// Numbers the points of lists as PointNumbers would if it got one list after the other. Runs in parallel.
/// @throws InputError if there are more than 2^31 - 1 points.
NumberedPoints number_together(std::span<const std::vector<PointNumbers::Place>> lists, const Executor& exec);

}  // namespace seamflow
