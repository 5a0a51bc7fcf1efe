#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "partition/formats/mesh_io.h"
#include "partition/io/input_file.h"

namespace seamflow {

/// A mesh file that has been read, kept open and not in memory, so that it can serve as the form for a file with other
/// positions. Renaming, replacing or removing it does no harm; a change within it is noticed.
class MeshSource {
  public:
    /// @param content of the file. @param mesh, kind what was read from it.
    MeshSource(OpenFile file, std::string_view content, const PolygonMesh& mesh, const FileKind& kind);

    /// As it was read, for messages.
    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

    [[nodiscard]] const FileKind& kind() const { return kind_; }

    /// Reads the file again.
    /// @throws InputError if it does not hold the same bytes any more.
    [[nodiscard]] InputFile read_again() const;

    /// Checks that the mesh has as many vertices as the file, and the same faces.
    /// @param path where the mesh is to be written, for the message.
    /// @throws OutputError
    void require_same_faces(const std::filesystem::path& path, const PolygonMesh& mesh) const;

  private:
    OpenFile file_;
    FileKind kind_;
    std::uint64_t content_checksum_;
    Index n_vertices_;
    Index n_faces_;
    std::uint64_t faces_checksum_;
};

}  // namespace seamflow
