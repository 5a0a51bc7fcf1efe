#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace seamflow {

/// Paths beside a result for n buffers in other files: the result's name with .bin for the first, and with -2.bin,
/// -3.bin … for further ones. Names that belong to other files are left out.
/// @param output to be written. @param input that was read.
std::vector<std::filesystem::path> paths_of_gltf_buffers(const std::filesystem::path& output,
                                                         const std::filesystem::path& input, std::size_t n);

}  // namespace seamflow
