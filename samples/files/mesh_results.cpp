#include "samples/files/mesh_results.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

constexpr const char* colours_among_extras = "colours";

}  // namespace

MeshOutput::MeshOutput(std::filesystem::path path, const MeshFile& input, const std::optional<LengthOnMesh>& weld)
    : path_(std::move(path))
    , input_(&input)
    , kind_(kind_for_writing(path_, input.kind))
    , seam_distance_(weld.value_or(0.0).value)
{
}

void MeshOutput::require_storable() const
{
    seamflow::require_storable(input_->mesh, path_, kind_);
}

/// The colours of vertices that a file of another format than the input's gets, too; no fields where there are none.
FileFields MeshOutput::colours(const Executor& exec) const
{
    if (kind_.format != FileFormat::Ply)
        return {};
    const std::vector<std::string> extras = extras_of(*input_->source, exec);
    if (std::ranges::find(extras, colours_among_extras) == extras.end())
        return {};
    try {
        return read_fields(*input_->source, std::vector<std::string>{"colour"}, exec);
    } catch (const InputError&) {
        // Not every vertex has one.
        return {};
    }
}

std::vector<std::string> MeshOutput::write_as(const std::filesystem::path& path, const PolygonMesh& mesh,
                                              const PolygonMesh* separated, const Executor& exec) const
{
    if (separated == nullptr && is_like_input())
        return write_mesh_like(*input_->source, path, mesh, exec, seam_distance_);
    const FileFields fields = separated == nullptr ? colours(exec) : FileFields();
    return write_mesh(path, separated == nullptr ? mesh : *separated, kind_, fields, exec);
}

std::vector<std::string> MeshOutput::remarks_on_losses(bool joined, const Executor& exec) const
{
    if (joined && is_like_input())
        return {};
    std::string list;
    const bool has_colours = joined && !colours(exec).names.empty();
    for (const std::string& extra : extras_of(*input_->source, exec)) {
        if (has_colours && extra == colours_among_extras)
            continue;
        list += list.empty() ? "" : ", ";
        list += extra;
    }
    if (list.empty())
        return {};
    return {path_.string() + " lacks the input's data besides the surface: " + list +
            (joined ? "; an output of the input's format keeps them"
                    : "; joined sub-meshes, in the input's format, keep them")};
}

std::string MeshOutput::remark_on_faces(const FaultLog& faults, bool joined) const
{
    // Copied by write_mesh_like.
    const bool stays = joined && is_like_input();
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

std::vector<std::string> MeshOutput::remarks_on_input(const std::filesystem::path& input, const FaultLog& left_out,
                                                      bool joined, const Executor& exec) const
{
    std::vector<std::string> remarks = remarks_on_losses(joined, exec);
    if (left_out.count > 0)
        remarks.push_back(remark_on_faces(left_out, joined));
    std::error_code ignored;
    if (std::filesystem::equivalent(input, path_, ignored))
        remarks.push_back("The result has replaced the input, in one go when it was complete.");
    return remarks;
}

}  // namespace seamflow
