#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/support/temporary_directory.h"

namespace seamflow::test {

/// A file with the bytes that are tried, in a directory of its own. While it lives, nothing may be allocated that is
/// larger than a small multiple of the file.
class FuzzedFile {
  public:
    FuzzedFile(const std::string& name, const std::uint8_t* bytes, std::size_t n_bytes);
    FuzzedFile(const FuzzedFile&) = delete;
    FuzzedFile& operator=(const FuzzedFile&) = delete;
    ~FuzzedFile();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// A place beside it, for what is made of it.
    [[nodiscard]] std::filesystem::path beside(const std::string& name) const { return path_.parent_path() / name; }

  private:
    std::filesystem::path path_;
};

/// Ends the process, as a crash would, saying what does not hold.
void demand(bool holds, const std::string& what);

}  // namespace seamflow::test
