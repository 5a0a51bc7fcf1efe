#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace seamflow {

/// The places of buffers in other files than the result.
class GltfBufferFiles {
  public:
    /// @param output to be written. @param input that was read.
    GltfBufferFiles(const std::filesystem::path& output, const std::filesystem::path& input);

    /// A name for a buffer: that of the result with .bin, and a number where that belongs to another file.
    std::string next_name();

    /// Beside the result.
    [[nodiscard]] std::filesystem::path place_of(const std::string& name) const { return folder_ / name; }

  private:
    std::filesystem::path folder_;
    std::string stem_;
    /// Those that the file which is replaced names, and nobody else.
    std::set<std::string> replaced_;
    int n_ = 0;
};

}  // namespace seamflow
