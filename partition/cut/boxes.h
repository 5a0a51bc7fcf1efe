#pragma once

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Divides points into boxes of about equally many points: the leaves of a k-d tree (Bentley, Multidimensional Binary
/// Search Trees, 1975) with the medians of a sample. Boxes and orders do not depend on how loops are run.
/// @param positions #points by 3, all finite.
/// @param n_boxes a power of two, at most 65,536.
/// @returns the points in each box, sorted along the longest side of their bounding box. Coincident points share a box,
/// so boxes may be empty.
IndexLists divide_into_boxes(const Points& positions, Index n_boxes, const Executor& exec);

}  // namespace seamflow
