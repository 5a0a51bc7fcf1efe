#pragma once

#include <optional>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// What the faces enclose with an origin, in length³: the volume of the cones from it to them, negative for faces that
/// are turned towards it. Polygons that are not planar are fans around the mean of their corners.
/// @param positions #V by 3, not necessarily those of the mesh.
double volume_of_cones(const PolygonMesh& mesh, const Points& positions, const Point& origin, const Loop& loop);

/// The volume that a closed surface encloses, in length³; empty if there is an edge that its faces do not run along as
/// often in one direction as in the other: then it is open, or its faces are not oriented alike.
std::optional<double> enclosed_volume(const PolygonMesh& mesh, const Loop& loop);

}  // namespace seamflow
