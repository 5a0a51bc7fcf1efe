#pragma once

#include <cstdint>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The checksum of all data that determine the result of a flow, except for the number of steps: its mesh, and its
/// options without those that have concern::no_result. The state of a flow belongs to flows of the same identity.
/// @param mesh before the first step; it may have been moved near the origin (see origin_offset).
std::uint64_t identify(const PolygonMesh& mesh, const FlowOptions& options);

}  // namespace seamflow
