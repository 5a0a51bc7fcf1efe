#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "samples/training/network.h"

namespace seamflow {

/// What a training takes.
struct DenoiserTraining {
    int n_stages = 4;
    /// Faces of each surface that each stage learns from.
    int samples_per_surface = 800;
    int epochs = 9;
    std::uint32_t seed = 1;
};

/// The networks of a trained denoiser, as mixing_weights.h has them.
struct TrainedDenoiser {
    std::vector<std::string> stages;
    std::string noise;
};

/// Trains one network for each stage (see denoise_normals), on what the stages before make of the noisy surfaces, and
/// the one that gives the noise. Depends on nothing but its arguments, not on how loops are run.
/// @param surfaces without noise. @param out what is reported meanwhile.
TrainedDenoiser train_denoiser(std::vector<PolygonMesh> surfaces, const DenoiserTraining& training, std::ostream& out,
                               const Executor& exec);

}  // namespace seamflow
