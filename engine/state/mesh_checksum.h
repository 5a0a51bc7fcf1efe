#pragma once

#include <cstdint>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The checksum of a mesh, with positions near the origin, as it moves (see origin_offset).
std::uint64_t checksum_of_mesh(const PolygonMesh& mesh);

}  // namespace seamflow
