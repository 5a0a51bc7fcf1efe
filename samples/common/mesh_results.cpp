#include "samples/common/mesh_results.h"

namespace seamflow {

namespace {

bool has_format_of(const MeshFile& input, const std::filesystem::path& path)
{
    return kind_for_writing(path, input.kind).format == input.kind.format;
}

}  // namespace

std::vector<std::string> write_state(const std::filesystem::path& path, const PolygonMesh& mesh,
                                     const PolygonMesh* separated, const MeshFile& input, const Loop& loop)
{
    if (separated == nullptr && has_format_of(input, path))
        return write_mesh_like(*input.source, path, mesh, loop);
    write_mesh(path, separated == nullptr ? mesh : *separated, kind_for_writing(path, input.kind), loop);
    return {};
}

std::vector<std::string> remarks_on_losses(const std::filesystem::path& path, bool joined, const MeshFile& input,
                                           const Loop& loop)
{
    if (joined && has_format_of(input, path))
        return {};
    std::string list;
    for (const std::string& extra : extras_of(*input.source, loop)) {
        list += list.empty() ? "" : ", ";
        list += extra;
    }
    if (list.empty())
        return {};
    return {path.string() + " does not have what the input holds besides the surface: " + list +
            (joined ? "; an output of the input's format has" : "; joined sub-meshes, in the input's format, have")};
}

}  // namespace seamflow
