#pragma once

#include <optional>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Lets the strength in a region rise smoothly from 0 at its rim, where vertices of strength 0 are next to others, to
/// the full value at a distance from it: by 10 t³ - 15 t⁴ + 6 t⁵, t = distance / length. (With a rise by t², a flow
/// would leave a crease, because dt over the squared distance is then the same all the way to the rim.) The boundary of
/// the mesh is no rim. Vertices that are joined along a seam count as one vertex, with the smallest of their
/// strengths.
/// @param strength #V, at least 0. @param length of the rise; 0: strengths stay as they are.
/// @param joined_within how far apart vertices along seams may be (see weld); empty: they are not joined.
/// @returns #V.
/// @throws InputError if there is not one strength for each vertex; OptionError if the length is negative or not
/// finite.
std::vector<double> feathered(const PolygonMesh& mesh, std::vector<double> strength, double length,
                              std::optional<double> joined_within = 0.0, const Executor& exec = run_serially);

}  // namespace seamflow
