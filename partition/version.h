#pragma once

#include <string_view>

/// The version by its parts, for #if. Versions follow semver.org: before 1.0.0 a new minor version may break programs
/// that worked, a new patch may not.
#define SEAMFLOW_VERSION_MAJOR 0
#define SEAMFLOW_VERSION_MINOR 1
#define SEAMFLOW_VERSION_PATCH 0

namespace seamflow {

/// The version of these headers, as in CMakeLists.txt: "major.minor.patch".
inline constexpr std::string_view version = "0.1.0";

}  // namespace seamflow
