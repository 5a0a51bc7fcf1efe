#pragma once

#include <span>
#include <string>

namespace seamflow {

/// The weights of each network of the cascade (see denoised_normals). They stand in mixing_weights.txt, in base 64: a
/// paragraph for each network, and one for noise_weights. That file is the output of samples/training, not to be
/// changed by hand.
///
/// First the number of layers; then, layer by layer, the numbers of its inputs and outputs; a scale for each input, a
/// scale and a bias for each output; then an integer for each pair of input and output, all outputs of an input
/// together, whose product with both scales is the weight.
std::span<const std::string> mixing_weights();

/// The weights of a network whose output is the logarithm of the noise (see MixingNetwork::apply).
const std::string& noise_weights();

}  // namespace seamflow
