#pragma once

#include <cstdint>

#include "engine/denoise/denoise_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The checksum of all data that determine the result of denoise(), except for the number of steps. The state of a run
/// belongs to runs of the same identity.
/// @param mesh before the first step; it may have been moved near the origin (see origin_offset).
/// @param options with the time step, if the method has one, in place of a radius.
std::uint64_t identify(const PolygonMesh& mesh, const DenoiseOptions& options);

}  // namespace seamflow
