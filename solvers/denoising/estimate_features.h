#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "solvers/denoising/normal_estimates.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// What tells estimates of normals from each other at each face, none of it dependent on how the surface is turned or
/// scaled, or on how its faces are numbered: how much shorter than 1 each vector is, and the chords between estimates;
/// and means of these over the faces around, near by and further off, which tell noise from shape.
struct EstimateFeatures {
    using Rows = VertexAverages::Rows;

    /// #F by 2 K - 1, for K estimates: logarithms of means over 6 rounds of VertexAverages::spread, and over 24.
    Rows near;
    Rows around;

    /// Replaces all by the features of these estimates.
    void measure(const NormalEstimates& estimates, const VertexAverages& averages, const Executor& exec = run_serially);
};

/// Appends the inputs of a network that mixes the estimates at face f: its features near by and further off, how much
/// shorter than 1 each estimate is there, and its chords to the anchors. The latter two are in units of the noise.
/// @param directions one per estimate: becomes the estimate at the face, of length 1, or 0 where it is 0.
void append_mixing_inputs(const NormalEstimates& estimates, const EstimateFeatures& features, Index f,
                          std::span<FaceVector> directions, std::vector<float>& numbers);

}  // namespace seamflow
