#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/io/byte_scanner.h"

namespace seamflow {

namespace {

constexpr std::size_t word_size = 4;

/// The first layout that fits the length of the data.
std::optional<PlyHeader> layout_of(std::string_view file, std::size_t offset)
{
    for (PlyHeader& header : layouts_of_binary_off(file, offset))
        if (are_all_elements(file, offset + binary_off_counts_bytes, header))
            return std::move(header);
    return std::nullopt;
}

/// @param type of four bytes.
PlyProperty word_list(const char* name, PlyType type)
{
    PlyProperty property;
    property.name = name;
    property.type = type;
    property.length_type = PlyType::UInt32;
    return property;
}

}  // namespace

PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing& slicing, FaultLog* faults)
{
    const std::optional<PlyHeader> layout = layout_of(file, offset);
    if (!layout)
        refuse_binary_off(path, file, offset);
    return read_ply_elements(path, file, offset + binary_off_counts_bytes, *layout, slicing, faults);
}

void refuse_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset)
{
    ByteScanner(path, file, offset, std::endian::big)
        .fail("the binary data do not end where their counts say, in either byte order; the file has been cut off, or "
              "holds more "
              "than coordinates and faces: convert the mesh to text OFF or to PLY");
}

std::vector<PlyHeader> layouts_of_binary_off(std::string_view file, std::size_t offset)
{
    std::vector<PlyHeader> headers;
    if (file.size() < offset + binary_off_counts_bytes)
        return headers;
    for (const auto& [encoding, colours_follow_faces] :
         {std::pair{Encoding::BinaryBigEndian, true}, std::pair{Encoding::BinaryLittleEndian, false},
          std::pair{Encoding::BinaryBigEndian, false}, std::pair{Encoding::BinaryLittleEndian, true}}) {
        const char* const counts = file.data() + offset;
        PlyElement vertices;
        vertices.name = "vertex";
        vertices.count = from_bytes<std::uint32_t>(counts, order_of(encoding));
        for (const std::string name : {"x", "y", "z"})
            vertices.properties.emplace_back().name = name;
        PlyElement faces;
        faces.name = "face";
        faces.count = from_bytes<std::uint32_t>(counts + word_size, order_of(encoding));
        faces.properties.push_back(word_list("vertex_indices", PlyType::Int32));
        if (colours_follow_faces)
            faces.properties.push_back(word_list("colours", PlyType::Float32));
        headers.push_back({encoding, {vertices, faces}});
    }
    return headers;
}

void require_fits_binary_off(const std::filesystem::path& path, const Points& vertices, Index first,
                             const Executor& exec)
{
    const auto too_large = select(exec, static_cast<Index>(vertices.rows()), [&](Index v) {
        return vertices.row(v).cwiseAbs().maxCoeff() > double{std::numeric_limits<float>::max()};
    });
    if (!too_large.empty())
        throw OutputError(
            fmt::format("{}: cannot be written: vertex {} (numbered from 0) has a coordinate too large for the single "
                        "precision of binary OFF; write another format",
                        path.string(), first + too_large.front()));
}

bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing& slicing)
{
    const auto layout = layout_of(file, offset);
    const std::endian order = order_of(layout ? layout->encoding : Encoding::BinaryBigEndian);
    require_fits_binary_off(output.path(), mesh.vertices, 0, slicing.exec);
    constexpr std::size_t vertex_bytes = 3 * word_size;
    const std::size_t first = offset + binary_off_counts_bytes;
    output.text(file.substr(0, first));
    write_elements(output, mesh.n_vertices(), elements_per_slice(slicing, vertex_bytes), slicing.exec,
                   [&](ByteWriter& slice, Index v) {
                       for (const double coordinate : mesh.vertices.row(v))
                           slice.binary(static_cast<float>(coordinate), order);
                   });
    output.text(file.substr(first + vertex_bytes * at(mesh.n_vertices())));
    return mesh.vertices.cast<float>().cast<double>() != mesh.vertices;
}

}  // namespace seamflow
