#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"

/// Checks of result files before the long work begins, so that no user waits an hour for a mistyped name.
namespace seamflow {

/// @throws OutputError if no file can be made at that path (`-` is not a file): its directory does not exist or may not
///         be written to, or the path names a directory.
void require_writable(const std::filesystem::path& path);

/// @throws OptionError if two of the files are the same one.
void require_different(const std::vector<std::filesystem::path>& paths);

/// For files other than meshes to read or write.
/// @throws OptionError if one of them is `-`.
void require_files(const std::vector<std::filesystem::path>& paths);

/// @throws OutputError for a mesh that a file of that kind cannot hold (see write_mesh).
void require_storable(const PolygonMesh& mesh, const std::filesystem::path& path, const FileKind& kind);

/// Room on the disk for a result, held while the work is done whose result it is. Nothing of it remains, however the
/// program ends.
class ReservedRoom {
  public:
    /// Reserves about as much as the mesh takes; nothing for standard output, or where the file system cannot do that.
    /// @throws OutputError if there is no such room.
    ReservedRoom(const std::filesystem::path& path, const MeshFile& file, const std::filesystem::path& input);
    ReservedRoom(const ReservedRoom&) = delete;
    ReservedRoom& operator=(const ReservedRoom&) = delete;
    ~ReservedRoom() { give_back(); }

    /// For the result.
    void give_back();

  private:
    int descriptor_ = -1;
};

/// Writes a text file, whole or not at all.
/// @throws OutputError naming the file.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace seamflow
