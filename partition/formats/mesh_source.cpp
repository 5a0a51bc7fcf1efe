#include "partition/formats/mesh_source.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "partition/errors.h"
#include "partition/formats/splicing.h"

namespace seamflow {

namespace {

std::uint64_t checksum(std::string_view bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}

/// Files are distinguished by a checksum of the checksums of their slices, which are computed several at a time.
std::uint64_t checksum(std::string_view content, const Executor& exec)
{
    constexpr std::size_t slice = std::size_t{1} << 20;
    std::vector<std::uint64_t> sums(content.size() / slice + 1);
    for_each(exec, static_cast<Index>(sums.size()),
             [&](Index i) { sums[i] = checksum(content.substr(usize(i) * slice, slice)); });
    return checksum({reinterpret_cast<const char*>(sums.data()), sums.size() * sizeof(std::uint64_t)});
}

std::uint64_t checksum_of_faces(const PolygonMesh& mesh, const Executor& exec)
{
    const auto of = [&](const std::vector<Index>& list) {
        return checksum({reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Index)}, exec);
    };
    // The factor keeps equal differences in the two lists from cancelling each other.
    return of(mesh.face_offsets) + 3 * of(mesh.face_vertices);
}

}  // namespace

MeshSource::MeshSource(OpenFile file, std::string_view content, const PolygonMesh& mesh, const FileKind& kind,
                       const Executor& exec)
    : file_(std::move(file))
    , kind_(kind)
    , content_checksum_(checksum(content, exec))
    , n_vertices_(mesh.n_vertices())
    , n_faces_(mesh.n_faces())
    , faces_checksum_(checksum_of_faces(mesh, exec))
{
}

InputFile MeshSource::read_again(const Executor& exec) const
{
    InputFile input(file_);
    if (checksum(input.content(), exec) != content_checksum_)
        throw InputError(changed_since_read(path()));
    return input;
}

void MeshSource::require_same_faces(const std::filesystem::path& path, const PolygonMesh& mesh,
                                    const Executor& exec) const
{
    std::string difference;
    if (mesh.n_vertices() != n_vertices_ || mesh.n_faces() != n_faces_)
        difference = fmt::format("{} vertices and {} faces, but that file {} and {}", mesh.n_vertices(), mesh.n_faces(),
                                 n_vertices_, n_faces_);
    else if (checksum_of_faces(mesh, exec) != faces_checksum_)
        difference = "other faces than that file";
    if (!difference.empty())
        throw OutputError(
            fmt::format("{}: cannot be written in the form of {}: the mesh has {}; write it without that form",
                        path.string(), file_.path().string(), difference));
}

}  // namespace seamflow
