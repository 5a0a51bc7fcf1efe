#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "partition/executor.h"
#include "partition/formats/mesh_file.h"
#include "partition/io/input_file.h"

namespace seamflow {

/// A mesh file that has been read, kept open and not in memory, so that it can serve as the template for a file with
/// other positions. Renaming, replacing or removing it does no harm; a change within it is detected.
class MeshSource {
  public:
    /// @param file, content the file that was read, and its content. @param mesh, kind the mesh read from it, and its
    /// kind.
    MeshSource(OpenFile file, std::string_view content, const PolygonMesh& mesh, const FileKind& kind,
               const Executor& exec);

    /// The path under which the file was read, for messages.
    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

    [[nodiscard]] const FileKind& kind() const { return kind_; }

    /// Reads the file again.
    /// @throws InputError if it no longer holds the same bytes.
    [[nodiscard]] InputFile read_again(const Executor& exec) const;

    /// Checks that the mesh has as many vertices as the file, and the same faces.
    /// @param path of the file to write, for the message.
    /// @throws OutputError
    void require_same_faces(const std::filesystem::path& path, const PolygonMesh& mesh, const Executor& exec) const;

  private:
    OpenFile file_;
    FileKind kind_;
    std::uint64_t content_checksum_;
    Index n_vertices_;
    Index n_faces_;
    std::uint64_t faces_checksum_;
};

}  // namespace seamflow
