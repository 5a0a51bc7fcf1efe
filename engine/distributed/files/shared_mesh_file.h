#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/executor.h"
#include "partition/formats/file_fields.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// How ranks share the work on a file. What they read and write does not depend on it.
struct FileSharing {
    /// Rank 0 alone reads and writes files up to this many bytes, in any format.
    std::uint64_t whole_up_to = std::uint64_t{16} << 20;
    /// Ranges of ranks begin at multiples of this many vertices and faces.
    Index block = block_size;
};

/// A mesh file that ranks read together, and write again with other positions. All ranks call its functions together.
class SharedMeshFile {
  public:
    /// @param path for messages.
    explicit SharedMeshFile(const std::filesystem::path& path)
        : name_(path.string())
    {
    }
    SharedMeshFile(const SharedMeshFile&) = delete;
    SharedMeshFile& operator=(const SharedMeshFile&) = delete;
    virtual ~SharedMeshFile() = default;

    /// This rank's range, without labels.
    /// @throws InputError as read_mesh, except for faces that read_faulty_mesh leaves out.
    virtual RankSlice read(Communicator& comm) = 0;

    /// Checks, before the long work begins, that `write` can write such a file.
    /// @throws OptionError
    virtual void require_writable_as(const std::filesystem::path& path) const = 0;

    /// Lets normals stay continuous across seams of this width where rank 0 writes the file (see write_mesh_like).
    void keep_normals_across(double seam_distance) { seam_distance_ = seam_distance; }

    /// Writes the mesh: in the form of the file (see write_mesh_like) where the format of `path` is the same, else as a
    /// plain mesh. It appears whole or not at all.
    /// @param vertices where the vertices of this rank's range are now.
    /// @returns remarks for the user, on rank 0.
    /// @throws OutputError, InputError (see write_mesh_like).
    virtual std::vector<std::string> write(Communicator& comm, const std::filesystem::path& path,
                                           const Points& vertices) = 0;

    /// Reads fields of the vertices of this rank's range, once the mesh was read.
    /// @throws InputError as seamflow::read_fields; also for files in slices that are not binary PLY files.
    virtual FileFields read_fields(Communicator& comm, const std::vector<std::string>& names);

    /// Writes the mesh as `write` does, with other fields. It stays where it was.
    /// @param fields those that were read, of this rank's range; they are rounded to what was written.
    /// @returns, throws as write_mesh_like.
    virtual std::vector<std::string> write_fields(Communicator& comm, const std::filesystem::path& path,
                                                  FileFields& fields);

    /// As write_labelled_ply, with the vertices as `write` takes them.
    /// @param labels of the faces of this rank's range.
    virtual void write_labelled(Communicator& comm, const std::filesystem::path& path, const Points& vertices,
                                const std::vector<Index>& labels) = 0;

    /// On rank 0, if it has read all of the file: the mesh, with the positions read or written last. Else null.
    [[nodiscard]] virtual const MeshFile* whole() const { return nullptr; }

    /// The faces of the file that were left out. On rank 0.
    [[nodiscard]] const FaultLog& faults() const { return faults_; }

  protected:
    FaultLog faults_{.of_faces_alone = true};
    double seam_distance_ = 0.0;

  private:
    [[noreturn]] void refuse_fields() const;

    std::string name_;
};

}  // namespace seamflow
