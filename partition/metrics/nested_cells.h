#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/metrics/regions.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// For each region: if it is what lies around a surface that is within a cell without touching the sheets around that
/// cell along an edge, the innermost such cell, else -1. The surface is then a hole of the cell.
///
/// Found by one line through each surface, whose crossings with all faces decide in which regions of the others a point
/// within the surface is. Exact, unless surfaces cross each other. Linear in the size of the mesh times the logarithm
/// of the number of surfaces, and nothing where there is only one.
/// @param positions #V by 3, those that the regions were found with.
std::vector<Index> containing_cells(const PolygonMesh& mesh, const Points& positions, const Regions& regions,
                                    const Executor& exec = run_serially);

}  // namespace seamflow
