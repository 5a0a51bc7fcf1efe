#pragma once

#include <filesystem>
#include <string>

#include "samples/training/denoiser_training.h"

namespace seamflow {

/// Checks that a file may be overwritten by weights: that it does not exist, or holds nothing but base 64.
/// @throws InputError
void require_replaceable(const std::filesystem::path& path);

/// The text of mixing_weights.txt with these weights.
std::string text_of_weights(const TrainedDenoiser& trained);

}  // namespace seamflow
