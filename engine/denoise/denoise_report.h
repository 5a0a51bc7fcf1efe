#pragma once

#include <optional>

#include "engine/measure/run_report.h"

namespace seamflow {

/// The noise that was removed.
struct NoiseReport {
    /// The root mean square of the noise along the normals, over the vertices that have noise, in lengths of the edges
    /// there.
    double deviation = 0.0;
    /// The fraction of vertices that have noise.
    double part = 0.0;
};

/// The report of denoise().
struct DenoiseReport : RunReport {
    /// Only of RemoveNoise, after the first step.
    std::optional<NoiseReport> noise;
    /// dt of one step, in length²; 0 where the noise is the amount.
    double time_step = 0.0;
    int threads = 0;
};

}  // namespace seamflow
