#pragma once

#include <optional>

#include "engine/measure/run_report.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The noise that was removed.
struct NoiseReport {
    /// The root mean square of the noise along the normals, over the vertices that have noise, in lengths of the edges
    /// there.
    double deviation = 0.0;
    /// The fraction of vertices that have noise.
    double part = 0.0;
};

/// The rounding of coordinates within which the surface was smoothed.
struct RoundingReport {
    /// The steps of x, y and z, in units of length; 0: not rounded.
    Point steps = Point::Zero();
    /// The number of iterations that the fairing took, and the largest motion of a coordinate in the last one, in
    /// smallest steps; 0 for marching cubes of equal steps, where there is no fairing.
    int iterations = 0;
    double last_motion = 0.0;
};

/// The report of denoise().
struct DenoiseReport : RunReport {
    /// Only of RemoveNoise, after the first step. Of rounded surfaces, the noise of the other components, if any.
    std::optional<NoiseReport> noise;
    /// Where the surface, or components of it, were smoothed within the rounding of their coordinates.
    std::optional<RoundingReport> rounding;
    /// dt of one step, in length²; 0 where the noise is the amount.
    double time_step = 0.0;
    int threads = 0;
};

}  // namespace seamflow
