#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace seamflow {

/// Paths beside a result for n buffers in other files: the result's name with .bin, and with a number if that name
/// belongs to another file.
/// @param output to be written. @param input that was read.
std::vector<std::filesystem::path> paths_of_gltf_buffers(const std::filesystem::path& output,
                                                         const std::filesystem::path& input, std::size_t n);

}  // namespace seamflow
