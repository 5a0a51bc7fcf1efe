#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/metrics/coordinate_steps.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Finds the vertices in the flat parts of a surface with rounded coordinates: the ends of a cylinder, the faces of a
/// plate, the sea beside hills. Rounding makes terraces of curved surfaces, too, but how wide they are changes slowly:
/// around a summit of curvature 1/R, the first terrace of height q has the radius √(2Rq), and the next ones are 0.41,
/// 0.32, … as wide. A facet in one plane that is much wider than the terrace beside it is therefore flat, and where
/// beside it is a wall, without a terrace, it is flat up to its rim. Small facets never are.
/// @param neighbours #V: the vertices that share an edge with each. @param planes of the coordinates; step 0: none.
/// @param steps of x, y and z, in units of length: of marching cubes twice those of the planes.
/// @returns #V: bit k is 1 where the surface is flat across axis k.
std::vector<std::uint8_t> flat_facets(const Points& points, const IndexLists& neighbours,
                                      const std::array<CoordinateSteps, 3>& planes, const Point& steps,
                                      const Executor& exec = run_serially);

}  // namespace seamflow
