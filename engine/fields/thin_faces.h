#pragma once

#include <span>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Whether a face has next to no area for the length of its edges: the entries of its K would be so large that their
/// rounding errors outweigh M in steps as long as those of distances and of what is extended. Faces without area (see
/// has_area) are thin.
bool is_thin(std::span<const Index> face, const Points& positions);

}  // namespace seamflow
