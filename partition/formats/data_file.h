#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "partition/formats/mesh_file.h"

namespace seamflow {

/// A file with data for a mesh: edges, or numbers of its vertices. Its name determines its format, once.
class DataFile {
  public:
    /// No file.
    DataFile() = default;
    DataFile(std::filesystem::path path)
        : path_(std::move(path))
        , format_(format_of(path_))
    {
    }

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// That of a mesh file (see format_of); nothing: a text file.
    [[nodiscard]] std::optional<FileFormat> format() const { return format_; }
    /// Whether there is no file.
    [[nodiscard]] bool empty() const { return path_.empty(); }

  private:
    std::filesystem::path path_;
    std::optional<FileFormat> format_;
};

}  // namespace seamflow
