#pragma once

#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow
{

/// Renumbers labels, all of them at least 0, to 0, 1, 2 … without gaps, keeping their order.
/// @returns the number of different labels.
Index compact_labels(std::vector<Index>& labels);

}  // namespace seamflow
