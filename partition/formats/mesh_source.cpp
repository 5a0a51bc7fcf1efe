#include "partition/formats/mesh_source.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// A number in which the length and all bytes have a part, the same for different bytes by accident alone (1 in 2^64).
std::uint64_t checksum(std::string_view bytes)
{
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
    std::uint64_t sum = bytes.size();
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t n = std::min(bytes.size(), sizeof word);
        std::memcpy(&word, bytes.data(), n);
        sum = (sum ^ word) * odd;
        sum ^= sum >> 32U;
        bytes.remove_prefix(n);
    }
    return sum;
}

std::uint64_t checksum_of_faces(const PolygonMesh& mesh)
{
    const auto of = [](const std::vector<Index>& list) {
        return checksum({reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Index)});
    };
    return of(mesh.face_offsets) + 3 * of(mesh.face_vertices);
}

}  // namespace

MeshSource::MeshSource(OpenFile file, std::string_view content, const PolygonMesh& mesh, const FileKind& kind)
    : file_(std::move(file))
    , kind_(kind)
    , content_checksum_(checksum(content))
    , n_vertices_(mesh.n_vertices())
    , n_faces_(mesh.n_faces())
    , faces_checksum_(checksum_of_faces(mesh))
{
}

InputFile MeshSource::read_again() const
{
    InputFile input(file_);
    if (checksum(input.content()) != content_checksum_)
        throw InputError(
            path().string() +
            ": the file has been changed since it was read, so that what it holds besides positions cannot "
            "be taken over; leave it alone until the result is written");
    return input;
}

void MeshSource::require_same_faces(const std::filesystem::path& path, const PolygonMesh& mesh) const
{
    const std::string refusal = path.string() + ": cannot be written in the form of " + file_.path().string() + ": ";
    if (mesh.n_vertices() != n_vertices_ || mesh.n_faces() != n_faces_)
        throw OutputError(refusal + "the mesh has " + std::to_string(mesh.n_vertices()) + " vertices and " +
                          std::to_string(mesh.n_faces()) + " faces, but that file " + std::to_string(n_vertices_) +
                          " and " + std::to_string(n_faces_) + "; write it without that form");
    if (checksum_of_faces(mesh) != faces_checksum_)
        throw OutputError(refusal + "the mesh has other faces than that file; write it without that form");
}

}  // namespace seamflow
