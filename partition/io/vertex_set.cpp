#include "partition/io/vertex_set.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "partition/errors.h"
#include "partition/io/index_lines.h"
#include "partition/io/input_file.h"
#include "partition/io/ply_header.h"
#include "partition/io/ply_source.h"

namespace seamflow {

namespace {

std::vector<Index> from_lines(const std::filesystem::path& path, Index n_vertices)
{
    constexpr IndexLineWords words{
        .name = "the number of a vertex",
        .remedy = "write one whole number for each vertex that is meant, each on a line of its own",
        .negative = "vertices are numbered from 0",
    };
    std::vector<Index> vertices;
    read_index_lines(path, words, [&](Index v, std::size_t line) {
        if (v >= n_vertices)
            throw InputError(place_of_line(path, line) + "there is no vertex " + std::to_string(v) + ": the mesh has " +
                             std::to_string(n_vertices) +
                             ", numbered from 0; use the file with the mesh it belongs to");
        vertices.push_back(v);
    });
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

/// The file has to have a property of vertices of that name, and as many vertices as the mesh.
void require_property(const TextScanner& scanner, const PlyHeader& header, Index n_vertices, std::string_view property)
{
    const PlyElement* const element = header.element("vertex");
    if (element == nullptr)
        scanner.fail("the file has no vertices; use one with the mesh's vertices and their property " +
                     in_quotes(property));
    if (element->count != static_cast<std::uint64_t>(n_vertices))
        throw InputError(scanner.position_of(element->line) + ": the file has " + std::to_string(element->count) +
                         " vertices, but the mesh has " + std::to_string(n_vertices) +
                         "; use it with the mesh it belongs to");
    const auto found = std::find_if(element->properties.begin(), element->properties.end(),
                                    [&](const PlyProperty& p) { return p.name == property; });
    if (found == element->properties.end() || found->length_type) {
        std::string names;
        for (const PlyProperty& p : element->properties)
            names += (names.empty() ? "" : ", ") + p.name;
        throw InputError(scanner.position_of(found == element->properties.end() ? element->line : found->line) +
                         ": the vertices have no number " + in_quotes(property) + ", but " + names +
                         "; name the property that says which are meant");
    }
}

/// Passes over a property of one element.
template <class Source>
void pass_over(Source& source, const PlyProperty& property)
{
    const std::int64_t n = property.length_type ? source.integer(*property.length_type) : 1;
    if (n < 0)
        source.position().fail("the length of the list " + in_quotes(property.name) + " is " + std::to_string(n) +
                               "; export the file again");
    source.require_room(property.type, n);
    source.pass_over(property.type, n);
}

template <class Source>
std::vector<Index> from_elements(Source source, const PlyHeader& header, std::string_view wanted)
{
    std::vector<Index> vertices;
    for (const PlyElement& element : header.elements) {
        const bool has_vertices = element.name == "vertex";
        for (std::uint64_t i = 0; i < element.count; ++i) {
            source.begin_element(element, i);
            for (const PlyProperty& property : element.properties) {
                if (!has_vertices || property.name != wanted) {
                    pass_over(source, property);
                    continue;
                }
                const double value = source.number(property.type);
                if (std::isnan(value))
                    source.position().fail(in_quotes(property.name) + " is not a number; write 0 or 1 for each vertex");
                if (value != 0.0)
                    vertices.push_back(static_cast<Index>(i));
            }
            source.end_element();
        }
        // What follows does not matter.
        if (has_vertices)
            break;
    }
    return vertices;
}

std::vector<Index> from_ply(const std::filesystem::path& path, Index n_vertices, std::string_view property)
{
    const InputFile file{OpenFile(path)};
    TextScanner scanner(path, file.content(), ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    require_property(scanner, header, n_vertices, property);
    if (header.encoding == Encoding::Ascii)
        return from_elements(PlyTextSource(scanner), header, property);
    const std::size_t begin = file.content().size() - scanner.rest().size();
    return from_elements(PlyBinarySource(path, file.content(), begin, header.encoding), header, property);
}

}  // namespace

std::vector<Index> read_vertex_set(const std::filesystem::path& path, Index n_vertices, std::string_view property)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension == ".ply" ? from_ply(path, n_vertices, property) : from_lines(path, n_vertices);
}

}  // namespace seamflow
