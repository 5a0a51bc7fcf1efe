#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace seamflow {

/// The whole of a file in memory.
class InputFile {
  public:
    /// @throws InputError naming the file and the system's reason; also if it is empty, or not a regular file.
    explicit InputFile(const std::filesystem::path& path);

    /// The bytes of the file; valid as long as this object.
    [[nodiscard]] std::string_view content() const { return {bytes_.get(), size_}; }

  private:
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
};

}  // namespace seamflow
