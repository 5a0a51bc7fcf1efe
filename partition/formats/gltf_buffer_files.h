#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace seamflow {

/// Places beside a result for n buffers in other files: its name with .bin, and a number where that belongs to another
/// file.
/// @param output to be written. @param input that was read.
std::vector<std::filesystem::path> places_of_gltf_buffers(const std::filesystem::path& output,
                                                          const std::filesystem::path& input, std::size_t n);

}  // namespace seamflow
