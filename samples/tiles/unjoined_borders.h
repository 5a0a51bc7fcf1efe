#pragma once

#include <cstdint>
#include <span>

#include "partition/metrics/bounding_box.h"
#include "samples/tiles/tile_files.h"

namespace seamflow {

/// Holds vertices where borders of tiles meet but are not joined: three sheets, faces turned round, other edges on the
/// two sides of a border, or tiles that overlap. They would come apart, because each tile moves its own. A border or
/// non-manifold vertex of one tile is held with all vertices at its place if another tile has a vertex there that has
/// another owner.
/// @param folder with owners, and positions of step 0 at the places of these. @param boxes around these, for
/// each tile.
/// @returns how many vertices are held, of all tiles.
std::int64_t hold_unjoined(const TileFolder& folder, std::span<const BoundingBox> boxes);

}  // namespace seamflow
