#pragma once

#include <string>

#include "samples/training/denoiser_training.h"

namespace seamflow {

/// The text of mixing_weights.txt with these weights.
std::string text_of_weights(const TrainedDenoiser& trained);

}  // namespace seamflow
