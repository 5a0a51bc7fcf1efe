#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/gltf.h"
#include "partition/formats/gltf_content.h"
#include "partition/formats/writing_checks.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The text of the least or largest coordinates, as in a file.
std::string bound_of(const Point& bound)
{
    OutputBuffer text;
    for (Index k = 0; k < 3; ++k) {
        text.text(k > 0 ? "," : "[");
        text.number(double{static_cast<float>(bound[k])});
    }
    return std::string(text.content()) + ']';
}

}  // namespace

void require_fits_gltf(const std::filesystem::path& path, const PolygonMesh& mesh)
{
    const auto refuse = [&](const char* reason) {
        throw OutputError(
            fmt::format("{}: cannot be written: {}; {}", path.string(), reason, write_polygons_instead()));
    };
    if (mesh.n_faces() == 0)
        refuse("the mesh has no faces, but glTF holds vertices of triangles");
    require_triangles(path, mesh, "glTF");
    require_floats(path, mesh.vertices, run_serially, "glTF");
    // The largest size of a file, whose bytes are counted in 32 bits; the text takes less than a kilobyte. A vertex
    // takes 12 bytes, as does a triangle.
    constexpr std::uint64_t most_bytes = std::numeric_limits<std::uint32_t>::max() - 1024;
    if (12 * (static_cast<std::uint64_t>(mesh.n_vertices()) + static_cast<std::uint64_t>(mesh.n_faces())) > most_bytes)
        refuse("the mesh takes more than the 4 GiB of a binary glTF file");
}

void write_gltf(OutputFile& file, const PolygonMesh& mesh, FileFormat format, const Slicing& slicing)
{
    const std::size_t position_bytes = 3 * sizeof(float) * usize(mesh.n_vertices());
    const std::size_t index_bytes = sizeof(std::uint32_t) * usize(mesh.n_corners());
    const Point least = mesh.vertices.colwise().minCoeff();
    const Point largest = mesh.vertices.colwise().maxCoeff();
    const auto text_with = [&](std::string_view uri) {
        return fmt::format(
            R"({{"asset":{{"version":"2.0","generator":"seamflow"}},"scene":0,"scenes":[{{"nodes":[0]}}],)"
            R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":{},"max":{}}},)"
            R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
            R"("bufferViews":[{{"buffer":0,"byteLength":{},"target":34962}},)"
            R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}}],)"
            R"("buffers":[{{{}"byteLength":{}}}]}})",
            mesh.n_vertices(), bound_of(least), bound_of(largest), mesh.n_corners(), position_bytes, position_bytes,
            index_bytes, uri, position_bytes + index_bytes);
    };
    const auto write_positions = [&](ByteWriter& slice, Index v) {
        for (Index k = 0; k < 3; ++k)
            slice.binary(static_cast<float>(mesh.vertices(v, k)), std::endian::little);
    };
    const auto write_corner = [&](ByteWriter& slice, Index c) {
        slice.binary(static_cast<std::uint32_t>(mesh.face_vertices[usize(c)]), std::endian::little);
    };
    if (format == FileFormat::Gltf) {
        OutputBuffer bytes;
        for (Index v = 0; v < mesh.n_vertices(); ++v)
            write_positions(bytes, v);
        for (Index c = 0; c < mesh.n_corners(); ++c)
            write_corner(bytes, c);
        return file.text(text_with(
            fmt::format(R"("uri":"{}",)", gltf_data("data:application/octet-stream;base64", bytes.content()))));
    }
    std::string text = text_with("");
    text.resize((text.size() + 3) / 4 * 4, ' ');
    write_glb_head(file, text, position_bytes + index_bytes + glb_chunk_header_bytes);
    file.binary(static_cast<std::uint32_t>(position_bytes + index_bytes), std::endian::little);
    file.text(std::string_view("BIN\0", 4));
    write_elements(file, mesh.n_vertices(), elements_per_slice(slicing, 3 * sizeof(float)), slicing.exec,
                   write_positions);
    write_elements(file, mesh.n_corners(), elements_per_slice(slicing, sizeof(std::uint32_t)), slicing.exec,
                   write_corner);
}

}  // namespace seamflow
