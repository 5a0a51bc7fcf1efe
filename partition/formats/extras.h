#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seamflow {

/// What a file that has been read holds besides a surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_obj(const std::filesystem::path& path, std::string_view text);
std::vector<std::string> extras_of_off(const std::filesystem::path& path, std::string_view content);
std::vector<std::string> extras_of_ply(const std::filesystem::path& path, std::string_view content);

}  // namespace seamflow
