#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/options/motion_options.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// A file that receives states of a mesh. Its form follows from its name and from the input, once: that of the input
/// (see write_mesh_like) if the formats are the same and the sub-meshes are joined, else that of a plain mesh.
class MeshOutput {
  public:
    /// @param input must outlive this. @param weld resolved: across seams of this width, shading that was continuous
    /// stays so (see write_mesh_like).
    /// @throws as kind_for_writing.
    MeshOutput(std::filesystem::path path, const MeshFile& input, const std::optional<LengthOnMesh>& weld = {});

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] const FileKind& kind() const { return kind_; }
    /// Whether the format is that of the input.
    [[nodiscard]] bool is_like_input() const { return kind_.format == input_->kind.format; }

    /// @throws OutputError if the format cannot hold the mesh of the input.
    void require_storable() const;

    /// @param separated the sub-meshes, each with its own copies of shared vertices; null: they are joined.
    /// @returns remarks for the user.
    /// @throws OutputError, InputError (see write_mesh_like).
    std::vector<std::string> write(const PolygonMesh& mesh, const PolygonMesh* separated,
                                   const Executor& exec = run_serially) const
    {
        return write_as(path_, mesh, separated, exec);
    }

    /// The same to another file of this form.
    std::vector<std::string> write_as(const std::filesystem::path& path, const PolygonMesh& mesh,
                                      const PolygonMesh* separated, const Executor& exec = run_serially) const;

    /// Lists the data of the input that the file will not have.
    /// @param joined whether the sub-meshes will be joined.
    /// @returns remarks for the user.
    [[nodiscard]] std::vector<std::string> remarks_on_losses(bool joined, const Executor& exec = run_serially) const;

    /// A remark on the parts of the input that were left out of the flow.
    /// @param joined see remarks_on_losses.
    [[nodiscard]] std::string remark_on_faces(const FaultLog& faults, bool joined) const;

    /// Remarks on what of the input is not in the file, or is replaced by it.
    /// @param input the path of the input. @param left_out see remark_on_faces. @param joined see remarks_on_losses.
    [[nodiscard]] std::vector<std::string> remarks_on_input(const std::filesystem::path& input,
                                                            const FaultLog& left_out, bool joined,
                                                            const Executor& exec = run_serially) const;

  private:
    [[nodiscard]] FileFields colours(const Executor& exec) const;

    std::filesystem::path path_;
    const MeshFile* input_;
    FileKind kind_;
    double seam_distance_;
};

}  // namespace seamflow
