#pragma once

#include <optional>

#include "partition/polygon_mesh.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

/// What makes a surface rough. At most one of both explains it.
struct SurfaceRoughness {
    /// Empty if it was not measured, or if the coordinates are rounded.
    std::optional<SurfaceNoise> noise;
    /// The steps of x, y and z where the coordinates are rounded, in units of length; 0: not this one.
    std::optional<Point> steps;
};

}  // namespace seamflow
