#pragma once

#include <string>
#include <string_view>

#include "samples/training/denoiser_training.h"

namespace seamflow {

/// The text of mixing_weights.cpp with other weights.
/// @param source its text now. @throws InputError unless it has lines that say where the weights begin and end.
std::string replace_weights(std::string_view source, const TrainedDenoiser& trained);

}  // namespace seamflow
