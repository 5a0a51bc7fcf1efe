#pragma once

#include <cstdint>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The checksum of a mesh after it is moved near the origin, as flows move it (see origin_offset).
std::uint64_t checksum_of_mesh(const PolygonMesh& mesh);

}  // namespace seamflow
