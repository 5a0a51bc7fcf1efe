#include "samples/files/mesh_results.h"

#include <algorithm>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/index_files.h"
#include "partition/io/input_position.h"

namespace seamflow {

namespace {

bool has_format_of(const MeshFile& input, const std::filesystem::path& path)
{
    return kind_for_writing(path, input.kind).format == input.kind.format;
}

constexpr const char* colours_among_extras = "colours";

/// The colours of vertices that a file of another format than the input's gets, too; no fields where there are none.
FileFields colours_for(const std::filesystem::path& path, const MeshFile& input, const Executor& exec)
{
    if (kind_for_writing(path, input.kind).format != FileFormat::Ply)
        return {};
    const std::vector<std::string> extras = extras_of(*input.source, exec);
    if (std::ranges::find(extras, colours_among_extras) == extras.end())
        return {};
    try {
        return read_fields(*input.source, std::vector<std::string>{"colour"}, exec);
    } catch (const InputError&) {
        // Not every vertex has one.
        return {};
    }
}

}  // namespace

std::vector<std::string> write_state(const std::filesystem::path& path, const PolygonMesh& mesh,
                                     const PolygonMesh* separated, const MeshFile& input, const Executor& exec,
                                     double seam_distance)
{
    if (separated == nullptr && has_format_of(input, path))
        return write_mesh_like(*input.source, path, mesh, exec, seam_distance);
    const FileKind kind = kind_for_writing(path, input.kind);
    return separated != nullptr ? write_mesh(path, *separated, kind, exec)
                                : write_mesh(path, mesh, kind, colours_for(path, input, exec), exec);
}

std::vector<std::string> remarks_on_losses(const std::filesystem::path& path, bool joined, const MeshFile& input,
                                           const Executor& exec)
{
    if (joined && has_format_of(input, path))
        return {};
    std::string list;
    const bool has_colours = joined && !colours_for(path, input, exec).names.empty();
    for (const std::string& extra : extras_of(*input.source, exec)) {
        if (has_colours && extra == colours_among_extras)
            continue;
        list += list.empty() ? "" : ", ";
        list += extra;
    }
    if (list.empty())
        return {};
    return {path.string() + " lacks the input's data besides the surface: " + list +
            (joined ? "; an output of the input's format keeps them"
                    : "; joined sub-meshes, in the input's format, keep them")};
}

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

std::string remark_on_faces(const FaultLog& faults, const std::filesystem::path& path, bool joined,
                            const FileKind& input)
{
    // Copied by write_mesh_like.
    const bool stays = joined && kind_for_writing(path, input).format == input.format;
    const std::size_t n_faces = faults.faces_left_out.size();
    const std::size_t n_rows = faults.n_harmless - n_faces;
    std::string text;
    if (n_faces > 0)
        text = fmt::format("{} a vertex twice or {} fewer than three corners, and {} no part in the flow",
                           n_faces == 1 ? "1 face names" : fmt::format("{} faces name", n_faces),
                           n_faces == 1 ? "has" : "have", n_faces == 1 ? "takes" : "take");
    if (n_rows > 0)
        text += fmt::format("{}{} more numbers than the file declares, which were ignored", text.empty() ? "" : "; ",
                            n_rows == 1 ? "1 row has" : fmt::format("{} rows have", n_rows));
    return fmt::format("{}; the result {} (the first: {}; --strict refuses such files).", text,
                       stays ? "keeps all this unchanged" : "leaves all this out", faults.messages.front());
}

std::vector<Index> labels_of_faces(const std::filesystem::path& path, Index n_faces, const std::vector<Index>& left_out)
{
    std::vector<Index> labels = read_labels(path, n_faces + static_cast<Index>(left_out.size()));
    auto next = left_out.begin();
    Index f = 0;
    std::erase_if(labels, [&](Index) {
        const bool is_left_out = next != left_out.end() && *next == f;
        next += is_left_out ? 1 : 0;
        ++f;
        return is_left_out;
    });
    return labels;
}

}  // namespace seamflow
