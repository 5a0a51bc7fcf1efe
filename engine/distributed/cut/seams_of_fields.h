#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "engine/distributed/cut/joined_seams.h"
#include "engine/distributed/ranks/communicator.h"

/// Fields of vertices that are joined along seams. All ranks call these functions together.
namespace seamflow {

/// Gives all vertices that are joined the mean of their fields.
/// @param fields #V of this rank's range by n. @param bounds of vertices (see SliceBounds).
void join_fields(Communicator& comm, const JoinedSeams& seams, std::span<const std::int64_t> bounds,
                 Eigen::MatrixXd& fields);

/// Gives vertices that no longer have faces the fields of the first of those that they are joined with.
void bring_back_fields(Communicator& comm, const JoinedSeams& seams, std::span<const std::int64_t> bounds,
                       Eigen::MatrixXd& fields);

}  // namespace seamflow
