#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "solvers/denoising/normal_estimates.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// Features by which a network weighs the estimates of the normal of a face: how much shorter than 1 each estimate is,
/// and the chord between each estimate and the next one; and the means of both over the faces around the face, near by
/// and further off, by which noise and shape differ. No feature depends on the orientation or scale of the surface, or
/// on the numbering of its faces.
struct EstimateFeatures {
    using Rows = VertexAverages::Rows;

    /// #F by 2 K - 1, for K estimates: K columns of shortness, then K - 1 columns of chords. Logarithms of means over 5
    /// rounds of VertexAverages::spread, and over 23 rounds.
    Rows near;
    Rows around;

    /// Replaces all features by the features of these estimates.
    void measure(const NormalEstimates& estimates, const VertexAverages& averages, const Executor& exec = run_serially);
};

/// Appends the inputs of a network that mixes the estimates at face f: its features near by and further off, how much
/// shorter than 1 each estimate is, and its chords to the anchors. Shortness and chords are in units of the noise.
/// @param directions one per estimate: receives the estimate at the face, scaled to length 1, or 0 where it is 0.
void append_mixing_inputs(const NormalEstimates& estimates, const EstimateFeatures& features, Index f,
                          std::span<FaceVector> directions, std::vector<float>& numbers);

}  // namespace seamflow
