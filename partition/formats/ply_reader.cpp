#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_elements.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_plain.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

namespace {

/// Reports an error in a line of the header.
[[noreturn]] void refuse(const TextScanner& scanner, std::size_t line, const std::string& complaint)
{
    throw InputError(scanner.position_of(line) + ": " + complaint);
}

void require_coordinates(const TextScanner& scanner, const PlyHeader& header)
{
    const PlyElement* const vertices = header.element("vertex");
    if (vertices == nullptr || vertices->count == 0)
        scanner.fail("the file has no vertices; export the mesh again");
    std::size_t n_found = 0;
    for (std::size_t p = 0; const PlyRole role : roles_of(*vertices)) {
        const PlyProperty& property = vertices->properties[p++];
        if (role != PlyRole::Other && property.length_type)
            refuse(scanner, property.line, "a coordinate must be one number, not a list; correct the header");
        n_found += role != PlyRole::Other ? 1 : 0;
    }
    if (n_found < 3)
        refuse(scanner, vertices->line, "the vertices lack x, y or z; correct the header or export the mesh again");
}

void require_corners(const TextScanner& scanner, const PlyElement& faces)
{
    std::size_t n_found = 0;
    for (std::size_t p = 0; const PlyRole role : roles_of(faces)) {
        const PlyProperty& property = faces.properties[p++];
        if (role != PlyRole::Corners)
            continue;
        if (!property.length_type || !is_integer(property.type))
            refuse(
                scanner, property.line,
                "the corners of a face must be a list of whole numbers; correct the header or export the mesh again");
        ++n_found;
    }
    if (n_found != 1)
        refuse(
            scanner, faces.line,
            fmt::format("the faces must have one list named vertex_indices or vertex_index, but have {}; correct the "
                        "header or export the mesh again",
                        n_found));
}

template <class Source>
PolygonMesh read_elements(Source source, const PlyHeader& header, FaultLog* faults)
{
    source.note_faults_in(faults);
    ElementReader<Source> reader(source, header);
    for (const PlyElement& element : header.elements)
        reader.read(element, 0, element.count);
    return reader.finish();
}

/// Reads a text file without one line per element; nothing if it has these, or cannot be read this way either.
std::optional<PolygonMesh> read_across_lines(TextScanner after_header, const PlyHeader& header, FaultLog* faults)
{
    if (!breaks_lines_freely(after_header, header))
        return std::nullopt;
    after_header.cross_lines();
    FaultLog own = faults != nullptr ? *faults : FaultLog();
    try {
        PolygonMesh mesh = read_elements(PlyTextSource(after_header), header, faults != nullptr ? &own : nullptr);
        if (faults != nullptr)
            *faults = std::move(own);
        return mesh;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_binary_slices(const std::filesystem::path& path, std::string_view file, std::size_t data,
                               const PlyHeader& header, const Slicing& slicing)
{
    if (header.element("vertex")->count == 0 || header.element("vertex")->count > std::numeric_limits<Index>::max())
        throw InputError("no vertices, or too many");
    const auto n_vertices = static_cast<Index>(header.element("vertex")->count);
    const std::vector<PlySlice> slices = slice_elements(file, data, header.encoding, header.elements, slicing);
    const auto source_of = [&](std::string_view bytes) {
        return PlyBinarySource(path, file, static_cast<std::size_t>(bytes.data() - file.data()), header.encoding);
    };
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(n_vertices);
    if (const PlyElement* const faces = header.element("face"))
        mesh.face_offsets.reserve(faces->count + 1);
    append_faces(mesh, static_cast<Index>(slices.size()), slicing.exec, [&](Index i, PolygonMesh& faces) {
        const auto first = static_cast<Index>(count_before(slices[i].begin, header, "vertex"));
        const MeshSlice place{mesh.vertices, first, faces};
        if (read_plain_slice(header, slices[i], place))
            return;
        PlyBinarySource source = source_of(slices[i].bytes);
        ElementReader<PlyBinarySource> reader(source, n_vertices, place);
        for_each_kind(header.elements, slices[i],
                      [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
                          reader.read(element, begin, end);
                      });
    });
    PlyBinarySource end = source_of(std::string_view(slices.back().bytes.data() + slices.back().bytes.size(), 0));
    end.finish();
    return mesh;
}

/// @throws InputError if there is any fault, not necessarily naming it.
PolygonMesh read_text_slices(const TextScanner& after_header, const PlyHeader& header, const Slicing& slicing)
{
    const std::vector<std::string_view> slices = after_header.slices(slicing.bytes);
    const std::vector<std::int64_t> lines = count_lines(after_header, slices, slicing.exec);
    if (static_cast<std::uint64_t>(lines.back()) != header.n_elements())
        throw InputError("the file ends too early, or goes on");
    const Index n_vertices = sum_of_counts(0, static_cast<std::int64_t>(header.element("vertex")->count));
    PolygonMesh mesh;
    mesh.vertices = uninitialised_points(n_vertices);
    if (const PlyElement* const faces = header.element("face"))
        mesh.face_offsets.reserve(faces->count + 1);
    append_faces(mesh, static_cast<Index>(slices.size()), slicing.exec, [&](Index i, PolygonMesh& faces) {
        const PlySlice slice{static_cast<std::uint64_t>(lines[i]), static_cast<std::uint64_t>(lines[i + 1]), slices[i]};
        PlyTextSource source(TextScanner(after_header, slice.bytes));
        const auto first = static_cast<Index>(count_before(slice.begin, header, "vertex"));
        ElementReader<PlyTextSource> reader(source, n_vertices, MeshSlice{mesh.vertices, first, faces});
        for_each_kind(header.elements, slice, [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
            reader.read(element, begin, end);
        });
    });
    return mesh;
}

}  // namespace

void require_surface(const TextScanner& scanner, const PlyHeader& header)
{
    require_coordinates(scanner, header);
    const PlyElement* const faces = header.element("face");
    const PlyElement* const strips = header.element("tristrips");
    if (faces != nullptr && faces->count > 0)
        require_corners(scanner, *faces);
    if (strips != nullptr && strips->count > 0)
        require_corners(scanner, *strips);
}

PolygonMesh read_ply_elements(const std::filesystem::path& path, std::string_view file, std::size_t begin,
                              const PlyHeader& header, const Slicing& slicing, FaultLog* faults)
{
    const auto in_one_go = [&] {
        return read_elements(PlyBinarySource(path, file, begin, header.encoding), header, faults);
    };
    if (file.size() - begin <= slicing.bytes)
        return in_one_go();
    return read_in_slices_if_faultless([&] { return read_binary_slices(path, file, begin, header, slicing); },
                                       in_one_go);
}

MeshFile read_ply(const std::filesystem::path& path, std::string_view file, const Slicing& slicing, FaultLog* faults)
{
    TextScanner scanner(path, file, ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    require_surface(scanner, header);
    const FileKind kind{FileFormat::Ply, header.encoding};
    if (header.encoding != Encoding::Ascii)
        return {read_ply_elements(path, file, file.size() - scanner.rest().size(), header, slicing, faults), kind};
    const auto in_one_go = [&] {
        if (std::optional<PolygonMesh> mesh = read_across_lines(scanner, header, faults))
            return *std::move(mesh);
        return read_elements(PlyTextSource(scanner), header, faults);
    };
    if (scanner.rest().size() <= slicing.bytes)
        return {in_one_go(), kind};
    return {read_in_slices_if_faultless([&] { return read_text_slices(scanner, header, slicing); }, in_one_go), kind};
}

}  // namespace seamflow
