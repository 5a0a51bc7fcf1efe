#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/off.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_source.h"
#include "partition/formats/writing_checks.h"
#include "partition/io/byte_scanner.h"

namespace seamflow {

namespace {

/// The bytes of an integer or float.
constexpr std::size_t word_size = 4;
/// The bytes of the three counts before the vertices.
constexpr std::size_t counts_bytes = 3 * word_size;

/// An element with a count at `counts`.
PlyElement element_of(const char* name, const char* counts, Encoding encoding)
{
    PlyElement element;
    element.name = name;
    element.count = from_bytes<std::uint32_t>(counts, order_of(encoding));
    return element;
}

/// A list of words, with its length in a word.
/// @param type of four bytes.
PlyProperty word_list(const char* name, PlyType type)
{
    PlyProperty property;
    property.name = name;
    property.type = type;
    property.length_type = PlyType::UInt32;
    return property;
}

/// Whether the file has all elements from `begin` on, and only padding after them.
bool are_all_elements(std::string_view file, std::size_t begin, const PlyHeader& header)
{
    PlySource source(ByteScanner({}, file, begin, order_of(header.encoding)), "mesh");
    try {
        for (const PlyElement& element : header.elements)
            source.pass_over(element, 0, element.count);
        source.finish();
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// The first of four layouts that fits the length of the data, as the header of a binary PLY file whose elements are
/// the bytes after the counts.
std::optional<PlyHeader> layout_of(std::string_view file, std::size_t offset)
{
    if (file.size() < offset + counts_bytes)
        return std::nullopt;
    for (const auto& [encoding, colours_follow_faces] :
         {std::pair{Encoding::BinaryBigEndian, true}, std::pair{Encoding::BinaryLittleEndian, false},
          std::pair{Encoding::BinaryBigEndian, false}, std::pair{Encoding::BinaryLittleEndian, true}}) {
        const char* const counts = file.data() + offset;
        PlyElement vertices = element_of("vertex", counts, encoding);
        for (const std::string name : {"x", "y", "z"})
            vertices.properties.emplace_back().name = name;
        PlyElement faces = element_of("face", counts + word_size, encoding);
        faces.properties.push_back(word_list("vertex_indices", PlyType::Int32));
        if (colours_follow_faces)
            faces.properties.push_back(word_list("colours", PlyType::Float32));
        PlyHeader header{encoding, {vertices, faces}};
        if (are_all_elements(file, offset + counts_bytes, header))
            return header;
    }
    return std::nullopt;
}

}  // namespace

PolygonMesh read_binary_off(const std::filesystem::path& path, std::string_view file, std::size_t offset,
                            const Slicing& slicing, FaultLog* faults)
{
    const std::optional<PlyHeader> layout = layout_of(file, offset);
    if (!layout)
        ByteScanner(path, file, offset, std::endian::big)
            .fail("the binary data do not end where their counts say, in either byte order; the file has been cut off, "
                  "or holds more than coordinates and faces: convert the mesh to text OFF or to PLY");
    return read_ply_elements({path, file, TextScanner(path, {}), *layout, file.substr(offset + counts_bytes)}, slicing,
                             faults);
}

bool rewrite_binary_off(OutputFile& output, std::string_view file, std::size_t offset, const PolygonMesh& mesh,
                        const Slicing& slicing)
{
    const auto layout = layout_of(file, offset);
    // The file has been read, so that a layout fits; the other order is never used.
    const std::endian order = order_of(layout ? layout->encoding : Encoding::BinaryBigEndian);
    require_floats(output.path(), mesh.vertices, slicing.exec, "binary OFF", "write another format");
    constexpr std::size_t vertex_bytes = 3 * word_size;
    const std::size_t first = offset + counts_bytes;
    output.text(file.substr(0, first));
    write_elements(output, mesh.n_vertices(), elements_per_slice(slicing, vertex_bytes), slicing.exec,
                   [&](ByteWriter& slice, Index v) {
                       for (const double coordinate : mesh.vertices.row(v))
                           slice.binary(static_cast<float>(coordinate), order);
                   });
    output.text(file.substr(first + vertex_bytes * usize(mesh.n_vertices())));
    return mesh.vertices.cast<float>().cast<double>() != mesh.vertices;
}

}  // namespace seamflow
