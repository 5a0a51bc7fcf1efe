#include "partition/formats/index_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_source.h"
#include "partition/index_lists.h"
#include "partition/io/input_file.h"
#include "partition/io/input_position.h"

namespace seamflow {

namespace {

/// The wording of messages about the numbers in a text file.
struct NumberWords {
    /// The word for a number: "a label", "labels".
    const char* name;
    const char* names;
    /// The word for an element that has a number: "face", "faces".
    const char* element;
    const char* elements;
    /// A remedy for a negative number.
    const char* negative;
};

constexpr NumberWords label_words{"a label", "labels", "face", "faces", "number the parts from 0"};
constexpr NumberWords weight_words{"a weight", "weights", "vertex", "vertices", ""};
constexpr NumberWords vertex_words{"the number of a vertex", "", "selected vertex", "", "vertices are numbered from 0"};

/// The line without its comment and without blanks at either end.
std::string_view trimmed(std::string_view line)
{
    line = line.substr(0, line.find('#'));
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos)
        return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

/// "path:line: ", the beginning of messages about a line.
std::string place_of_line(const std::filesystem::path& path, std::size_t line)
{
    return fmt::format("{}:{}: ", path.string(), line);
}

[[noreturn]] void refuse_line(const std::filesystem::path& path, std::size_t line, std::string_view text,
                              const std::string& why)
{
    throw InputError(fmt::format("{}{} {}", place_of_line(path, line), in_quotes(text), why));
}

bool is_weight(double value)
{
    return value >= 0.0 && std::isfinite(value);
}

Index parse_index(std::string_view text, const std::filesystem::path& path, std::size_t line, const NumberWords& words)
{
    Index value = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
        refuse_line(path, line, text, "is too large or too small: use numbers from 0 to 2147483647");
    if (error != std::errc() || end != text.data() + text.size())
        refuse_line(path, line, text,
                    fmt::format("is not {}: write one whole number for each {}, each on a line of its own", words.name,
                                words.element));
    if (value < 0)
        refuse_line(path, line, text, fmt::format("is negative: {}", words.negative));
    return value;
}

double parse_weight(std::string_view text, const std::filesystem::path& path, std::size_t line)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !is_weight(value))
        refuse_line(path, line, text,
                    "is not a weight: write a number of at least 0 for each vertex, each on a line of its own");
    return value;
}

/// Reads a text file with one number per line.
/// @param take called in order with each line that is not blank, and its number, counted from 1.
/// @returns the number of lines.
template <class Take>
std::size_t read_lines(const std::filesystem::path& path, Take&& take)
{
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path))
        throw InputError(path.string() + ": cannot open the file for reading: check its name and permissions");
    std::string text;
    std::size_t line = 0;
    while (std::getline(file, text)) {
        ++line;
        if (const std::string_view number = trimmed(text); !number.empty())
            take(number, line);
    }
    if (file.bad())
        throw InputError(place_of_line(path, line) +
                         "the file could not be read to its end: copy it to a working disk");
    return line;
}

/// Reads a text file with one number per line for each of n elements.
/// @param parse called with a line that is not blank, and its number.
template <class Parse>
auto read_each(const std::filesystem::path& path, Index n, const NumberWords& words, Parse&& parse)
{
    std::vector<decltype(parse(std::string_view(), std::size_t{}))> numbers;
    const std::size_t n_lines = read_lines(path, [&](std::string_view text, std::size_t line) {
        const auto number = parse(text, line);
        if (numbers.size() == usize(n))
            throw InputError(fmt::format("{}more {} than the mesh has {} ({}): remove the surplus, or use the {} with "
                                         "the mesh they belong to",
                                         place_of_line(path, line), words.names, words.elements, n, words.names));
        numbers.push_back(number);
    });
    if (numbers.size() != usize(n))
        throw InputError(fmt::format("{}the file ends after {} of {} {}: give one for each {}, or use the {} with the "
                                     "mesh they belong to",
                                     place_of_line(path, std::max<std::size_t>(n_lines, 1)), numbers.size(), n,
                                     words.names, words.element, words.names));
    return numbers;
}

std::vector<Index> from_lines(const std::filesystem::path& path, Index n_vertices)
{
    std::vector<Index> vertices;
    read_lines(path, [&](std::string_view text, std::size_t line) {
        const Index v = parse_index(text, path, line, vertex_words);
        if (v >= n_vertices)
            throw InputError(fmt::format("{}there is no vertex {}: the mesh has {}, numbered from 0; use the file with "
                                         "the mesh it belongs to",
                                         place_of_line(path, line), v, n_vertices));
        vertices.push_back(v);
    });
    sort_unique(vertices);
    return vertices;
}

/// Checks that the file has a vertex property of this name, and as many vertices as the mesh.
void require_property(const TextScanner& scanner, const PlyHeader& header, Index n_vertices, std::string_view property)
{
    const PlyElement* const element = header.element("vertex");
    if (element == nullptr)
        scanner.fail("the file has no vertices; use one with the mesh's vertices and their property " +
                     in_quotes(property));
    if (element->count != static_cast<std::uint64_t>(n_vertices))
        throw InputError(
            fmt::format("{}: the file has {} vertices, but the mesh has {}; use it with the mesh it belongs to",
                        scanner.position_of(element->line), element->count, n_vertices));
    require_number(scanner, *element, property);
}

/// @param take called with each vertex, its number, and the source, in order.
template <class Take>
void read_ply_property(const std::filesystem::path& path, Index n_vertices, std::string_view property, Take&& take)
{
    const InputFile file{OpenFile(path)};
    TextScanner scanner(path, file.content(), ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    require_property(scanner, header, n_vertices, property);
    const PlyData data{path, file.content(), header, scanner, scanner.rest(), PlyUse::OtherData};
    const PlyElement& vertices = *header.element("vertex");
    data.scan(
        data.whole(), vertices, columns_of(vertices, [&](const PlyProperty& p) { return p.name == property ? 0 : -1; }),
        [&](PlySource& source, Index v, Index, const PlyProperty& wanted) {
            take(v, source.number(wanted.type), source);
        },
        [](PlySource&, Index) {});
}

std::vector<Index> from_ply(const std::filesystem::path& path, Index n_vertices, std::string_view property)
{
    std::vector<Index> vertices;
    read_ply_property(path, n_vertices, property, [&](Index v, double value, auto& source) {
        if (std::isnan(value))
            source.position().fail(in_quotes(property) + " is not a number; write 0 or 1 for each vertex");
        if (value != 0.0)
            vertices.push_back(v);
    });
    return vertices;
}

}  // namespace

std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces)
{
    return read_each(path, n_faces, label_words, [&](std::string_view text, std::size_t line) {
        return parse_index(text, path, line, label_words);
    });
}

std::vector<Index> read_vertex_set(const std::filesystem::path& path, Index n_vertices, std::string_view property)
{
    return format_of(path) == FileFormat::Ply ? from_ply(path, n_vertices, property) : from_lines(path, n_vertices);
}

std::vector<double> read_vertex_weights(const std::filesystem::path& path, Index n_vertices, std::string_view property)
{
    if (format_of(path) != FileFormat::Ply)
        return read_each(path, n_vertices, weight_words,
                         [&](std::string_view text, std::size_t line) { return parse_weight(text, path, line); });
    std::vector<double> weights;
    weights.reserve(usize(n_vertices));
    read_ply_property(path, n_vertices, property, [&](Index, double value, auto& source) {
        if (!is_weight(value))
            source.position().fail(in_quotes(property) +
                                   " is not a weight; write a number of at least 0 for each vertex");
        weights.push_back(value);
    });
    return weights;
}

std::vector<double> read_vertex_strengths(const std::filesystem::path& path, Index n_vertices,
                                          std::string_view property)
{
    std::vector<double> strengths(usize(n_vertices), 0.0);
    if (format_of(path) != FileFormat::Ply) {
        for (const Index v : from_lines(path, n_vertices))
            strengths[v] = 1.0;
        return strengths;
    }
    read_ply_property(path, n_vertices, property, [&](Index v, double value, auto& source) {
        if (!(value >= 0.0 && value <= 1.0))
            source.position().fail(fmt::format("{} is {:g}; write a number from 0 (the vertex stays) to 1 "
                                               "(it moves like without a region) for each vertex",
                                               in_quotes(property), value));
        strengths[v] = value;
    });
    return strengths;
}

}  // namespace seamflow
