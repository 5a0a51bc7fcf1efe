#pragma once

#include "samples/meshes/building.h"
#include "samples/meshes/meshes.h"

namespace seamflow {

/// @throws OptionError naming the field.
void require_valid(const HeightFieldShape& shape);

/// Sets z of the grid's vertices from their x and y, with noise except on the border of the grid.
void raise(PolygonMesh& mesh, const Grid& grid, const HeightFieldShape& shape);

/// A mesh without faces: the vertices of a regular grid over the unit square, z = 0.
PolygonMesh flat_grid(const Grid& grid, std::size_t corners, std::size_t faces);

}  // namespace seamflow
