#pragma once

#include <cstdint>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "solvers/rounding/bounded_fairing.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "solvers/rounding/surface_parts.h"

namespace seamflow {

/// Which parts of a surface are rough because their coordinates were rounded: those that bend much less once they are
/// smooth within half a step, while only few vertices are at their bounds. Thin vessels cannot bend much less; they are
/// known by the corners of voxels, of which shapes that are made of blocks have few.
/// @param boxes around the rounded positions. @param positions #V by 3: smooth, in the boxes.
/// @param knows_vessels whether thin vessels are looked for in faces of voxels; in marching cubes they always are.
/// @returns per part: 1 if rounding explains its roughness.
std::vector<std::uint8_t> parts_explained_by_rounding(const SurfaceParts& parts, const CoordinateBounds& bounds,
                                                      const Boxes& boxes, const Points& positions, bool knows_vessels,
                                                      const Executor& exec = run_serially);

}  // namespace seamflow
