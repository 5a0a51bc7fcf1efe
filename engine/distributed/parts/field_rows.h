#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"

/// Fields of a mesh of which each rank has a range of the vertices. All ranks call these functions together, with the
/// same number of columns.
namespace seamflow {

/// Fetches the rows of some vertices from the ranks that have them.
/// @param of_range #V of this rank's range by n. @param numbers in the whole mesh, ascending.
/// @param bounds of vertices (see SliceBounds).
/// @returns #numbers by n.
Eigen::MatrixXd fetch_fields(Communicator& comm, const Eigen::MatrixXd& of_range, std::span<const std::int64_t> numbers,
                             std::span<const std::int64_t> bounds);

/// Takes the faces of vertices without data out of the ranges of all ranks.
/// @param lacks of the vertices of this rank's range: 1 where there are none.
void leave_out_faces_without_data(Communicator& comm, std::span<const std::uint8_t> lacks, RankSlice& slice);

/// Puts the rows of all parts into the ranges to which they belong.
/// @param numbers of the vertices of a part. @param of_part #numbers by n; rows that several ranks have are the same.
/// @param of_range vertices that no rank names keep their rows.
void collect_fields(Communicator& comm, std::span<const std::int64_t> numbers, const Eigen::MatrixXd& of_part,
                    Eigen::MatrixXd& of_range);

}  // namespace seamflow
