#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/ranks/communicator.h"
#include "partition/point_numbers.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Points of all ranks, with equal ones merged.
struct JoinedPoints {
    /// Those of this rank that no rank before it has, in their order.
    Points firsts;
    /// The number of each point of this rank among those of all: they are in the order in which they first come, rank
    /// by rank.
    std::vector<std::int64_t> numbers;
};

/// Finds equal points (see PointNumbers) of several ranks. Each point is looked for on one rank, given by its hash, so
/// that no rank has all of them. All ranks call this together.
/// @param own #V by 3: of this rank, all different.
JoinedPoints join_points(Communicator& comm, const Points& own);

}  // namespace seamflow
