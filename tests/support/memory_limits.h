#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/mean_curvature_flow.h"

namespace seamflow::test {

/// The least memory limit, by what a flow says that refuses a lower one; none where it says something else.
std::optional<std::size_t> least_limit_named(const std::string& message);

/// The least limit that a flow takes; none where it takes any.
std::optional<std::size_t> least_memory_limit(const PolygonMesh& mesh, FlowOptions options);

}  // namespace seamflow::test
