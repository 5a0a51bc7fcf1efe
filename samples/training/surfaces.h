#pragma once

#include <cstdint>
#include <optional>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A surface to learn from, closed or cut open, of at least 1,000 triangles. One in three is a part with sharp edges,
/// in some cases twisted or bent; one is smooth with a pattern or two; and one is rich in detail.
/// @param number of the surface, 0, 1, … @returns nothing where none could be made.
std::optional<PolygonMesh> make_training_surface(std::uint32_t seed, int number);

}  // namespace seamflow
