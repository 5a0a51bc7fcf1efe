#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_plain.h"
#include "partition/formats/ply_source.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

/// Checks that the vertices have x, y and z, one number each.
void require_coordinates(const PlyData& data)
{
    const TextScanner& scanner = data.after_header;
    const PlyElement* const vertices = data.header.element("vertex");
    if (vertices == nullptr || vertices->count == 0)
        scanner.fail("the file has no vertices; export the mesh again");
    std::size_t n_found = 0;
    for (std::size_t p = 0; const Index column : coordinates_in(*vertices)) {
        const PlyProperty& property = vertices->properties[p++];
        if (column >= 0 && property.length_type)
            scanner.fail_at(property.line, "a coordinate must be one number, not a list; correct the header");
        n_found += column >= 0 ? 1 : 0;
    }
    if (n_found < 3)
        scanner.fail_at(vertices->line, "the vertices lack x, y or z; correct the header or export the mesh again");
}

/// Checks that faces or strips, if there are any, have one list of corners, of whole numbers.
/// @param name of the element.
void require_corners(const PlyData& data, std::string_view name)
{
    const TextScanner& scanner = data.after_header;
    const PlyElement* const faces = data.header.element(name);
    if (faces == nullptr || faces->count == 0)
        return;
    std::size_t n_found = 0;
    for (std::size_t p = 0; const Index column : corners_in(*faces)) {
        const PlyProperty& property = faces->properties[p++];
        if (column < 0)
            continue;
        if (!property.length_type || !is_integer(property.type))
            scanner.fail_at(
                property.line,
                "the corners of a face must be a list of whole numbers; correct the header or export the mesh again");
        ++n_found;
    }
    if (n_found != 1)
        scanner.fail_at(faces->line,
                        "the faces must have one list named vertex_indices or vertex_index, but have {}; correct the "
                        "header or export the mesh again",
                        n_found);
}

/// Stands in a list of corners for the end of a triangle strip.
constexpr Index end_of_strip = -2;

/// Adds the triangles of strips. Every vertex of a strip except the first two forms a triangle with the two before it,
/// every other triangle reversed. Triangles that name a vertex twice join strips, and are skipped.
void add_strips(MeshBuilder& builder, const std::vector<Index>& corners)
{
    std::size_t begin = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (corners[k] == end_of_strip)
            begin = k + 1;
        if (k < begin + 2)
            continue;
        std::array<Index, 3> triangle{corners[k - 2], corners[k - 1], corners[k]};
        if ((k - begin) % 2 == 1)
            std::swap(triangle[0], triangle[1]);
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
            builder.add_face(triangle);
    }
}

/// Reads the vertices begin to end - 1.
void read_vertices(PlySource& source, MeshBuilder& builder, const PlyElement& vertices, std::uint64_t begin,
                   std::uint64_t end)
{
    std::array<double, 3> point{};
    source.scan(
        vertices, begin, end, coordinates_in(vertices),
        [&](Index, Index column, const PlyProperty& property) { point[column] = source.real(property.type); },
        [&](Index) {
            source.end_element();
            builder.add_vertex(point);
        });
}

/// Reads the faces, or triangle strips, begin to end - 1.
/// @param n_vertices the number of vertices of the whole file.
void read_faces(PlySource& source, MeshBuilder& builder, std::int64_t n_vertices, const PlyElement& faces,
                std::uint64_t begin, std::uint64_t end)
{
    const bool are_strips = faces.name == "tristrips";
    std::vector<Index> corners;
    source.scan(
        faces, begin, end, corners_in(faces),
        [&](Index, Index, const PlyProperty& list) {
            corners.clear();
            source.integers(list, [&](std::int64_t v) {
                corners.push_back(are_strips && v == -1 ? end_of_strip : builder.vertex(v, n_vertices));
            });
        },
        [&](Index) {
            source.end_element();
            if (are_strips)
                add_strips(builder, corners);
            else
                builder.add_face(corners);
        });
}

/// Reads all elements of a slice.
void read_slice(PlySource& source, MeshBuilder& builder, const PlyHeader& header, const PlySlice& slice)
{
    const auto n_vertices = static_cast<std::int64_t>(header.element("vertex")->count);
    PlyData::for_each_kind(header.elements, slice,
                           [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
                               if (element.name == "vertex")
                                   read_vertices(source, builder, element, begin, end);
                               else if (element.name == "face" || element.name == "tristrips")
                                   read_faces(source, builder, n_vertices, element, begin, end);
                               else
                                   source.pass_over(element, begin, end);
                           });
}

/// The number of vertices among the first `end` elements of a file.
std::uint64_t vertices_before(std::uint64_t end, const PlyHeader& header)
{
    std::uint64_t n = 0;
    PlyData::for_each_kind(header.elements, {0, end},
                           [&](const PlyElement& element, std::uint64_t, std::uint64_t n_here) {
                               n = element.name == "vertex" ? n_here : n;
                           });
    return n;
}

/// Reads the mesh from the slices of a file.
/// @param faults if not null, collects faults instead of throwing; null if there are several slices.
/// @throws InputError for a fault that `faults` does not collect; the message names it if there is one slice.
PolygonMesh read_slices(const PlyData& data, std::span<const PlySlice> slices, const Executor& exec, FaultLog* faults)
{
    const std::uint64_t n_vertices = data.header.element("vertex")->count;
    constexpr std::uint64_t most = std::numeric_limits<Index>::max();
    if (n_vertices > most)
        data.source(slices.front()).position().fail("more than {} vertices; divide the mesh into several files", most);
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(static_cast<Index>(n_vertices));
    const PlyElement* const faces_of_file = data.header.element("face");
    mesh.face_offsets.reserve(faces_of_file != nullptr ? faces_of_file->count + 1 : 1);
    append_faces(mesh, static_cast<Index>(slices.size()), exec, [&](Index i, PolygonMesh& faces) {
        const auto first = static_cast<Index>(vertices_before(slices[i].begin, data.header));
        const MeshSlice mesh_slice{mesh.vertices, first, faces};
        // Messages of read_plain_slice need not name faults: a single slice is not read by it.
        const bool may_be_plain = data.header.encoding != Encoding::Ascii && slices.size() > 1;
        if (may_be_plain && read_plain_slice(data.header, slices[i], mesh_slice))
            return;
        PlySource source = data.source(slices[i]);
        source.note_faults_in(faults);
        MeshBuilder builder(source.position(), 0, mesh_slice);
        read_slice(source, builder, data.header, slices[i]);
        if (slices.size() == 1)
            source.finish();
        require_vertices(source.position(), static_cast<std::int64_t>(n_vertices));
    });
    // Nothing but padding may follow the last slice.
    const std::string_view last = slices.back().bytes;
    data.source({.bytes = last.substr(last.size())}).finish();
    return mesh;
}

/// Reads a file that may have faults, in one slice. If the file does not have one line per element, and cannot be read
/// across lines either, it is read as if it had one line each, so that messages name lines.
PolygonMesh read_in_one_go(const PlyData& data, FaultLog* faults)
{
    PlySlice whole = data.whole();
    if (whole.crosses_lines) {
        const FaultLog before = faults != nullptr ? *faults : FaultLog();
        try {
            return read_slices(data, {&whole, 1}, run_serially, faults);
        } catch (const InputError&) {
            whole.crosses_lines = false;
            if (faults != nullptr)
                *faults = before;
        }
    }
    return read_slices(data, {&whole, 1}, run_serially, faults);
}

/// Reads a file in several slices.
/// @throws InputError if there is any fault; the message need not name it.
PolygonMesh read_in_slices(const PlyData& data, const Slicing& slicing)
{
    const std::vector<PlySlice> slices = data.slices(data.header.elements, slicing);
    if (slices.front().crosses_lines)
        throw InputError("no line per element");
    return read_slices(data, slices, slicing.exec, nullptr);
}

}  // namespace

PolygonMesh read_ply_elements(const PlyData& data, const Slicing& slicing, FaultLog* faults)
{
    return read_in_slices_if_faultless([&] { return read_in_slices(data, slicing); },
                                       [&] { return read_in_one_go(data, faults); });
}

MeshFile read_ply(const std::filesystem::path& path, std::string_view file, const Slicing& slicing, FaultLog* faults)
{
    const PlyData data = ply_data_of(path, file);
    require_coordinates(data);
    for (const char* const name : {"face", "tristrips"})
        require_corners(data, name);
    return {read_ply_elements(data, slicing, faults), {FileFormat::Ply, data.header.encoding}};
}

}  // namespace seamflow
