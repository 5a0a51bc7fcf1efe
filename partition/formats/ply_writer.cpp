#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/formats/ply.h"
#include "partition/formats/ply_source.h"

namespace seamflow {

namespace {

/// The content to write.
struct PlyContent {
    const PolygonMesh& mesh;
    Encoding encoding;
    const PlyExtras& extras;
    /// Whether a face has more than 255 sides (see has_long_face).
    bool long_faces;
};

/// The text of the header.
std::string header_of(const PlyContent& content)
{
    const std::string colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const PlyExtras& extras = content.extras;
    std::string header =
        fmt::format("ply\nformat {} 1.0\nelement vertex {}\n",
                    ply_encodings[static_cast<std::size_t>(content.encoding)], content.mesh.n_vertices());
    header += "property double x\nproperty double y\nproperty double z\n";
    header += extras.vertex_colours.empty() ? "" : colour;
    for (const NamedColumn& column : extras.vertex_values)
        header += fmt::format("property double {}\n", column.name);
    header += fmt::format("element face {}\nproperty list {} int vertex_indices\n", content.mesh.n_faces(),
                          content.long_faces ? "int" : "uchar");
    header += extras.face_labels.empty() ? "" : colour + "property int label\n";
    for (const FaceNumbers& list : extras.face_numbers)
        header += "property int " + list.name + "\n";
    return header + "end_header\n";
}

/// Writes a file, or a slice of one.
class PlyWriter {
  public:
    PlyWriter(ByteWriter& file, const PlyContent& content)
        : file_(file)
        , content_(content)
        , extras_(content.extras)
    {
    }

    void write_vertex(Index v);
    void write_face(Index f);

  private:
    void write_colour(const Colour& colour);
    /// Ends the line in a text file.
    void end_element()
    {
        if (content_.encoding == Encoding::Ascii)
            file_.text("\n");
        begins_line_ = true;
    }

    /// Writes numbers, in a binary file all at once.
    template <class Number>
    void write(std::span<const Number> values)
    {
        if (content_.encoding != Encoding::Ascii)
            return file_.binary(values, order_of(content_.encoding));
        for (const Number value : values)
            write(value);
    }

    /// Writes a number; in a text file after a blank, except at the beginning of a line.
    void write(auto value)
    {
        if (content_.encoding != Encoding::Ascii)
            return file_.binary(value, order_of(content_.encoding));
        if (!begins_line_)
            file_.text(" ");
        begins_line_ = false;
        file_.number(value);
    }

    ByteWriter& file_;
    const PlyContent& content_;
    const PlyExtras& extras_;
    bool begins_line_ = true;
};

void PlyWriter::write_colour(const Colour& colour)
{
    for (const std::uint8_t channel : colour)
        write(channel);
}

void PlyWriter::write_vertex(Index v)
{
    write(std::span<const double>(content_.mesh.vertices.row(v).data(), 3));
    if (!extras_.vertex_colours.empty())
        write_colour(extras_.vertex_colours[v]);
    for (const NamedColumn& column : extras_.vertex_values)
        write(column.values[v]);
    end_element();
}

void PlyWriter::write_face(Index f)
{
    const auto corners = content_.mesh.face(f);
    if (content_.long_faces)
        write(static_cast<std::int32_t>(corners.size()));
    else
        write(static_cast<std::uint8_t>(corners.size()));
    write(corners);
    if (!extras_.face_labels.empty()) {
        write_colour(colour_of(extras_.face_labels[f]));
        write(extras_.face_labels[f]);
    }
    for (const FaceNumbers& list : extras_.face_numbers)
        write(list.values[f]);
    end_element();
}

/// Whether a face has more than 255 sides: then all corner lists store their lengths in four bytes, else in one.
bool has_long_face(const PolygonMesh& mesh)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (mesh.face(f).size() > 255)
            return true;
    return false;
}

}  // namespace

void write_ply(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing,
               const PlyExtras& extras)
{
    const PlyContent content{mesh, encoding, extras, has_long_face(mesh)};
    file.text(header_of(content));
    constexpr std::size_t element_bytes = 32;
    const Index per_slice = elements_per_slice(slicing, element_bytes);
    write_elements(file, mesh.n_vertices(), per_slice, slicing.exec,
                   [&](ByteWriter& slice, Index v) { PlyWriter(slice, content).write_vertex(v); });
    write_elements(file, mesh.n_faces(), per_slice, slicing.exec,
                   [&](ByteWriter& slice, Index f) { PlyWriter(slice, content).write_face(f); });
}

namespace {

/// The range of a column that was read.
std::optional<WholeRange> range_of(const FileFields& fields, Index column)
{
    return usize(column) < fields.whole.size() ? fields.whole[column] : std::nullopt;
}

/// The columns red, green and blue, if they were read as colours and each vertex has a colour.
std::optional<std::array<Index, 3>> columns_of_colours(const FileFields& fields)
{
    std::array<Index, 3> columns{};
    std::ranges::transform(std::array{"red", "green", "blue"}, columns.begin(),
                           [&](const char* name) { return fields.column(name); });
    // Whole colours have 8 or 16 bits. Other colours are those of a text file, see fields_of_colours.
    constexpr double most_whole = 65535.0;
    for (const Index c : columns) {
        if (c < 0 || fields.values.col(c).hasNaN())
            return {};
        const auto range = range_of(fields, c);
        const bool is_whole = range && range->least == 0.0 && range->largest <= most_whole;
        if (!is_whole && (usize(c) >= fields.decimals.size() || fields.decimals[c] != Decimals::SingleText))
            return {};
    }
    return columns;
}

/// The colours of the vertices, scaled to 0 to 255.
/// @param columns of red, green and blue. @returns #V.
std::vector<Colour> colours_in(const FileFields& fields, const std::array<Index, 3>& columns)
{
    std::vector<Colour> colours(static_cast<std::size_t>(fields.values.rows()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const double brightest = range_of(fields, columns[k]).value_or(WholeRange{0.0, 1.0}).largest;
        for (std::size_t v = 0; v < colours.size(); ++v)
            colours[v][k] = static_cast<std::uint8_t>(std::lround(
                255.0 * std::clamp(fields.values(static_cast<Index>(v), columns[k]) / brightest, 0.0, 1.0)));
    }
    return colours;
}

}  // namespace

void write_ply(OutputFile& file, const PolygonMesh& mesh, Encoding encoding, const Slicing& slicing,
               const FileFields& fields)
{
    const auto columns = columns_of_colours(fields);
    const std::vector<Colour> colours = columns ? colours_in(fields, *columns) : std::vector<Colour>();
    std::vector<NamedColumn> others;
    for (Index c = 0; c < std::ssize(fields.names); ++c)
        if (!columns || std::ranges::find(*columns, c) == columns->end())
            others.push_back({fields.names[c], {fields.values.col(c).data(), usize(mesh.n_vertices())}});
    write_ply(file, mesh, encoding, slicing, {.vertex_colours = colours, .vertex_values = others});
}

}  // namespace seamflow
