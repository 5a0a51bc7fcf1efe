#include "partition/formats/ply_ranges.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/ply_elements.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

PlyHeader read_header(TextScanner& scanner)
{
    PlyHeader header = read_ply_header(scanner);
    require_surface(scanner, header);
    return header;
}

bool has_list(const PlyElement& element)
{
    return std::ranges::any_of(element.properties, [](const PlyProperty& p) { return p.length_type.has_value(); });
}

/// The bytes of an element whose lists have three numbers each.
std::size_t bytes_with_triples(const PlyElement& element)
{
    std::size_t n = 0;
    for (const PlyProperty& property : element.properties)
        n += property.length_type ? size_in_bytes(*property.length_type) + 3 * size_in_bytes(property.type)
                                  : size_in_bytes(property.type);
    return n;
}

void require_few(const std::filesystem::path& path, const PlyElement* element)
{
    if (element != nullptr && element->count > std::numeric_limits<Index>::max())
        throw InputError(fmt::format("{}: the file has {} elements '{}', more than 2147483647; cut it into several",
                                     path.string(), element->count, element->name));
}

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what)
{
    throw InputError(fmt::format("{}: {}, so ranks cannot read it in slices; export it as a text PLY file, or as a "
                                 "binary one whose vertices come first and have no lists",
                                 path.string(), what));
}

}  // namespace

PlyRanges::PlyRanges(std::filesystem::path path, std::string_view content)
    : path_(std::move(path))
    , content_(content)
{
    TextScanner scanner(path_, content, ply_syntax);
    header_ = read_header(scanner);
    elements_begin_ = content.size() - scanner.rest().size();
    const PlyElement* const faces = header_.element("face");
    require_few(path_, &vertex_element());
    require_few(path_, faces);
    if (has_list(vertex_element()))
        refuse(path_, "its vertices have lists");
    if (faces != nullptr && faces < &vertex_element())
        refuse(path_, "its faces come before its vertices");
    try {
        find_elements();
    } catch (const InputError&) {
        // Reading the elements one by one reports where they are not as the header declares.
        PlyBinarySource source(path_, content, elements_begin_, header_.encoding);
        for (const PlyElement& element : header_.elements)
            for (std::uint64_t i = 0; i < element.count; ++i)
                pass_over(source, element, i);
        throw;
    }
}

PlyRanges::PlyRanges(std::filesystem::path path, std::string_view content, PlyHeader header, std::size_t begin)
    : path_(std::move(path))
    , content_(content)
    , header_(std::move(header))
    , elements_begin_(begin)
{
    require_few(path_, &vertex_element());
    require_few(path_, header_.element("face"));
    find_elements();
}

void PlyRanges::find_elements()
{
    faces_ = header_.element("face");
    std::size_t offset = elements_begin_;
    for (const PlyElement& element : header_.elements) {
        if (&element == faces_)
            break;
        if (element.name == "vertex")
            vertices_begin_ = offset;
        offset = pass_over_elements(content_, offset, order_of(header_.encoding), element, element.count);
    }
    faces_begin_ = offset;
    vertex_bytes_ = bytes_with_triples(vertex_element());
    triangle_bytes_ = faces_ != nullptr ? bytes_with_triples(*faces_) : 0;
}

Points PlyRanges::vertices(Index begin, Index end) const
{
    Points points = uninitialised_points(end - begin);
    PolygonMesh unused;
    const auto first = static_cast<std::size_t>(bytes_of_vertices(begin, end).data() - content_.data());
    PlyBinarySource source(path_, content_, first, header_.encoding);
    ElementReader<PlyBinarySource> reader(source, n_vertices(), MeshSlice{points, 0, unused});
    reader.read(vertex_element(), at(begin), at(end));
    return points;
}

std::size_t PlyRanges::end_of_faces(std::size_t byte, Index begin, Index end) const
{
    if (begin == end)
        return byte;
    if (byte > content_.size())
        throw InputError("the file ends before");
    return pass_over_elements(content_, byte, order_of(header_.encoding), *faces_, at(end - begin));
}

PolygonMesh PlyRanges::faces(std::size_t byte, Index begin, Index end, FaultLog& faults) const
{
    PolygonMesh mesh;
    if (begin == end)
        return mesh;
    Points unused(0, 3);
    PlyBinarySource source(path_, content_, byte, header_.encoding);
    source.note_faults_in(&faults);
    ElementReader<PlyBinarySource> reader(source, n_vertices(), MeshSlice{unused, 0, mesh});
    reader.read(*faces_, at(begin), at(end));
    return mesh;
}

void PlyRanges::require_end(std::size_t byte) const
{
    PlyBinarySource source(path_, content_, byte, header_.encoding);
    const PlyElement* const last = faces_ != nullptr ? faces_ : &header_.elements.back();
    for (const PlyElement& element : header_.elements)
        if (&element > last)
            for (std::uint64_t i = 0; i < element.count; ++i)
                pass_over(source, element, i);
    source.finish();
}

}  // namespace seamflow
