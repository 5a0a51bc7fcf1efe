#include "samples/files/mesh_input.h"

#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/text.h"

namespace seamflow {

void require_faces(const std::filesystem::path& path, std::int64_t n_faces, const FaultLog& left_out)
{
    if (n_faces > 0)
        return;
    const std::string reason =
        left_out.messages.empty()
            ? "vertices alone are not a surface; export the mesh with its faces"
            : fmt::format("{} cannot be used (the first: {})", counted(left_out.faces_left_out.size(), "face", "faces"),
                          left_out.messages.front());
    throw InputError(fmt::format("{}: has no faces: {}", path.string(), reason));
}

MeshFile read_surface(const std::filesystem::path& path, FaultLog* left_out, const Executor& exec)
{
    MeshFile file = left_out == nullptr ? read_mesh(path, exec) : read_faulty_mesh(path, *left_out, exec);
    require_faces(path, file.mesh.n_faces(), left_out == nullptr ? FaultLog() : *left_out);
    return file;
}

}  // namespace seamflow
