#pragma once

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The offset to subtract from the positions of a surface far from the origin relative to its own extent, so that the
/// flow does not lose precision to that distance: a point near its middle, on a grid so coarse that the difference is
/// exact. Vertices without faces are ignored. It is zero if the surface is not far away, if there is none, if a
/// position is not finite, or if a face names a vertex that does not exist.
Point origin_offset(const PolygonMesh& mesh);

}  // namespace seamflow
