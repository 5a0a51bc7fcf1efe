#include "partition/formats/index_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/executor.h"
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

bool is_weight(double value)
{
    return value >= 0.0 && std::isfinite(value);
}

/// A text file with one number on each line.
class LineFile final : public InputPosition {
  public:
    explicit LineFile(const std::filesystem::path& path)
        : path_(path.string())
        , file_(path)
    {
        if (!file_ || std::filesystem::is_directory(path))
            throw InputError(path_ + ": cannot open the file for reading: check its name and permissions");
    }

    /// Goes to the next number. False at the end of the file.
    bool next()
    {
        for (text_ = {}; text_.empty() && std::getline(file_, line_); ++n_lines_)
            text_ = trimmed(line_);
        if (file_.bad())
            fail("the file could not be read to its end: copy it to a working disk");
        // Messages about an empty file are about its first line.
        n_lines_ = std::max<std::size_t>(n_lines_, 1);
        return !text_.empty();
    }

    /// Reads the number, which must be whole and at least 0.
    void read(Index& value, const NumberWords& words) const
    {
        const std::errc error = parse(value);
        if (error == std::errc::result_out_of_range)
            fail("{} is too large or too small: use numbers from 0 to 2147483647", in_quotes(text_));
        if (error != std::errc())
            fail("{} is not {}: write one whole number for each {}, each on a line of its own", in_quotes(text_),
                 words.name, words.element);
        if (value < 0)
            fail("{} is negative: {}", in_quotes(text_), words.negative);
    }

    /// Reads the number, which must be a weight.
    void read(double& value, const NumberWords& words) const
    {
        if (parse(value) != std::errc() || !is_weight(value))
            fail("{} is not {}: write a number of at least 0 for each {}, each on a line of its own", in_quotes(text_),
                 words.name, words.element);
    }

  private:
    [[nodiscard]] std::string position() const override { return fmt::format("{}:{}", path_, n_lines_); }

    std::errc parse(auto& value) const
    {
        const char* const last = text_.data() + text_.size();
        const auto [end, error] = std::from_chars(text_.data(), last, value);
        return error == std::errc() && end != last ? std::errc::invalid_argument : error;
    }

    std::string path_;
    std::ifstream file_;
    std::string line_;
    /// The number, in the line.
    std::string_view text_;
    std::size_t n_lines_ = 0;
};

/// Reads a text file with a number for each of n elements.
template <class Number>
std::vector<Number> read_each(const std::filesystem::path& path, Index n, const NumberWords& words)
{
    LineFile file(path);
    std::vector<Number> numbers;
    for (Number number{}; file.next(); numbers.push_back(number)) {
        file.read(number, words);
        if (std::ssize(numbers) == n)
            file.fail("more {} than the mesh has {} ({}): remove the surplus, or use the {} with the mesh they belong "
                      "to",
                      words.names, words.elements, n, words.names);
    }
    if (std::ssize(numbers) != n)
        file.fail("the file ends after {} of {} {}: give one for each {}, or use the {} with the mesh they belong to",
                  numbers.size(), n, words.names, words.element, words.names);
    return numbers;
}

/// Reads a text file with numbers of vertices.
std::vector<Index> read_list(const std::filesystem::path& path, Index n_vertices)
{
    LineFile file(path);
    std::vector<Index> vertices;
    for (Index v = 0; file.next(); vertices.push_back(v)) {
        file.read(v, vertex_words);
        if (v >= n_vertices)
            file.fail("there is no vertex {}: the mesh has {}, numbered from 0; use the file with the mesh it belongs "
                      "to",
                      v, n_vertices);
    }
    sort_unique(vertices);
    return vertices;
}

/// Reads a property of the vertices of a .ply file.
/// @param complaint gives the fault of a number and a remedy, to follow the name of the property; empty: none.
/// @returns n_vertices numbers; nothing for any other file.
std::optional<std::vector<double>> read_column(const DataFile& file, Index n_vertices, std::string_view property,
                                               std::string (*complaint)(double number))
{
    if (file.format() != FileFormat::Ply)
        return {};
    const std::string name = in_quotes(property);
    const InputFile input{OpenFile(file.path())};
    const PlyData data = ply_data_of(file.path(), input.content(), PlyUse::OtherData);
    const PlyElement* const vertices = data.header.element("vertex");
    if (vertices == nullptr)
        data.after_header.fail("the file has no vertices; use one with the mesh's vertices and their property {}",
                               name);
    if (vertices->count != static_cast<std::uint64_t>(n_vertices))
        data.after_header.fail_at(vertices->line,
                                  "the file has {} vertices, but the mesh has {}; use it with the mesh it belongs to",
                                  vertices->count, n_vertices);
    require_number(data.after_header, *vertices, property);
    std::vector<double> numbers;
    numbers.reserve(vertices->count);
    data.scan(
        data.whole(), *vertices, columns_of(*vertices, {property}),
        [&](PlySource& source, Index, Index, const PlyProperty& declared) {
            const double number = numbers.emplace_back(source.number(declared.type));
            if (const std::string why = complaint(number); !why.empty())
                source.position().fail("{} {}", name, why);
        },
        [](PlySource&, Index) {});
    return numbers;
}

}  // namespace

std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces)
{
    return read_each<Index>(path, n_faces, label_words);
}

std::vector<Index> read_vertex_set(const DataFile& file, Index n_vertices, std::string_view property)
{
    const auto marks = read_column(file, n_vertices, property, [](double mark) -> std::string {
        return std::isnan(mark) ? "is not a number; write 0 or 1 for each vertex" : "";
    });
    if (!marks)
        return read_list(file.path(), n_vertices);
    return select(run_serially, n_vertices, [&](Index v) { return (*marks)[v] != 0.0; });
}

std::vector<double> read_vertex_weights(const DataFile& file, Index n_vertices, std::string_view property)
{
    auto weights = read_column(file, n_vertices, property, [](double weight) -> std::string {
        return is_weight(weight) ? "" : "is not a weight; write a number of at least 0 for each vertex";
    });
    return weights ? std::move(*weights) : read_each<double>(file.path(), n_vertices, weight_words);
}

std::vector<double> read_vertex_strengths(const DataFile& file, Index n_vertices, std::string_view property)
{
    auto strengths = read_column(file, n_vertices, property, [](double strength) {
        return strength >= 0.0 && strength <= 1.0
                   ? std::string()
                   : fmt::format("is {:g}; write a number from 0 (the vertex stays) to 1 (it moves like without a "
                                 "region) for each vertex",
                                 strength);
    });
    if (strengths)
        return std::move(*strengths);
    std::vector<double> all(n_vertices, 0.0);
    for (const Index v : read_list(file.path(), n_vertices))
        all[v] = 1.0;
    return all;
}

}  // namespace seamflow
