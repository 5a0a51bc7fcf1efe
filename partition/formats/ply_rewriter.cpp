#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_numbers.h"
#include "partition/formats/ply_source.h"
#include "partition/formats/splicing.h"

namespace seamflow {

namespace {

/// The names of the first columns of vertices that are rewritten; the columns of FileFields follow.
constexpr std::array<std::string_view, 6> names_of_columns = {"x", "y", "z", "nx", "ny", "nz"};
constexpr auto first_field = static_cast<Index>(names_of_columns.size());

/// The change of one property of the vertices when a file is rewritten. Changes after those of the file's properties
/// add properties.
struct Change {
    /// An index in names_of_columns; from 6 on: a column of FileFields; -1: the property does not change.
    Index column = -1;
    /// The type of the number in the written file.
    PlyType type = PlyType::Float64;
};

/// The kind of the vertex properties nx, ny and nz.
enum class Normals {
    None,
    /// Floating-point numbers.
    Usable,
    /// Not all three exist, or they are integers, whose scale is unknown, or lists.
    Other
};

/// The kind of the normals of the vertices.
Normals normals_of(const PlyElement& vertices)
{
    Index n_found = 0;
    Index n_usable = 0;
    for (const PlyProperty& property : vertices.properties) {
        if (std::find(names_of_columns.begin() + 3, names_of_columns.end(), property.name) == names_of_columns.end())
            continue;
        ++n_found;
        n_usable += !property.length_type && !is_integer(property.type) ? 1 : 0;
    }
    return n_usable == 3 ? Normals::Usable : n_found > 0 ? Normals::Other : Normals::None;
}

/// The change of each property of the vertices to new positions and normals.
/// @param fits whether the types of x, y and z in the file can hold the new coordinates; if not, they become double.
std::vector<Change> changes_of(const PlyElement& vertices, const std::array<bool, 3>& fits, bool with_normals)
{
    const auto n_columns = with_normals ? names_of_columns.end() : names_of_columns.begin() + 3;
    std::vector<Change> changes;
    for (const PlyProperty& property : vertices.properties) {
        const auto column = std::find(names_of_columns.begin(), n_columns, property.name);
        Change change;
        if (column != n_columns) {
            change = {static_cast<Index>(column - names_of_columns.begin()), property.type};
            if (change.column < 3 && !fits[change.column])
                change.type = PlyType::Float64;
        }
        changes.push_back(change);
    }
    return changes;
}

/// The change by which a property of the file gets the values of a field.
/// @param remarks gets sentences for the user.
/// @throws OutputError naming `target`, the file to write.
Change change_of_field(const PlyProperty& property, Index column, const FileFields& fields,
                       const std::filesystem::path& target, std::vector<std::string>& remarks)
{
    const auto refuse = [&](const char* why) {
        throw OutputError(fmt::format("{}: cannot be written: the property {} is {}", target.string(),
                                      in_quotes(property.name), why));
    };
    const auto values = fields.values.col(column);
    const bool is_whole = is_integer(property.type);
    if (property.length_type)
        refuse("a list in the file that was read, not a number; give the values another name");
    if (is_whole && values.hasNaN())
        refuse("a whole number in the file that was read, but some values are not; give each vertex a number");
    if (reaches(property.type, values))
        return {first_field + column, property.type};
    if (!is_whole)
        return {first_field + column, PlyType::Float64};
    remarks.push_back(clamping_remark(property.name, "of " + std::string(property.type_word)));
    return {first_field + column, property.type};
}

/// Adds the changes of fields: of properties with their names, or of new properties.
/// @param changes one per property of the vertices; new properties are appended. @param target the file to write.
/// @returns remarks for the user, in sentences. @throws OutputError as change_of_field does.
std::vector<std::string> add_fields(std::vector<Change>& changes, const PlyElement& vertices, const FileFields& fields,
                                    const std::filesystem::path& target)
{
    std::vector<std::string> remarks;
    std::string rounded;
    for (Index column = 0; column < static_cast<Index>(fields.names.size()); ++column) {
        const PlyProperty* const property = vertices.property(fields.names[column]);
        if (property == nullptr) {
            changes.push_back({first_field + column, PlyType::Float64});
            continue;
        }
        changes[property - vertices.properties.data()] = change_of_field(*property, column, fields, target, remarks);
        const auto values = fields.values.col(column);
        if (is_integer(property->type) && (values.array() != values.array().round()).any())
            rounded += fmt::format("{}{}", rounded.empty() ? "" : ", ", in_quotes(property->name));
    }
    if (!rounded.empty())
        remarks.push_back("the values of " + rounded +
                          " are rounded to the nearest whole numbers, as which the file holds them");
    return remarks;
}

/// The new numbers of the vertices.
struct NewVertices {
    const Points& positions;
    /// Nothing: normals do not change.
    const std::optional<MovedNormals>& normals;
    /// #V by columns of FileFields: the new values of the fields.
    const Eigen::MatrixXd& fields;
};

/// Writes the vertices of a slice of a file.
class VertexRewriter {
  public:
    VertexRewriter(Splicer splicer, const PlyData& data, const std::vector<Change>& changes, const NewVertices& now)
        : splicer_(splicer)
        , data_(data)
        , changes_(changes)
        , now_(now)
        , vertices_(*data.header.element("vertex"))
        , numbers_(vertices_.properties.size())
    {
    }

    /// @returns whether positions were rounded.
    bool rewrite(const PlySlice& slice);

  private:
    /// A number of the present vertex that may change.
    struct Number {
        /// The number as written in the file.
        std::string_view part;
        double value;
    };

    void write_vertex(Index v, std::string_view end);
    void write(ByteWriter& file, const Change& change, double number);

    Splicer splicer_;
    const PlyData& data_;
    const std::vector<Change>& changes_;
    const NewVertices& now_;
    const PlyElement& vertices_;
    /// The numbers of the present vertex, one per property.
    std::vector<Number> numbers_;
    /// The normal of the present vertex in the file.
    Point normal_ = Point::Zero();
    /// Whether a position has been rounded.
    bool rounded_ = false;
};

bool VertexRewriter::rewrite(const PlySlice& slice)
{
    std::vector<Index> properties;
    for (std::size_t p = 0; p < numbers_.size(); ++p)
        properties.push_back(changes_[p].column < 0 ? -1 : static_cast<Index>(p));
    data_.scan(
        slice, vertices_, properties,
        [&](PlySource& source, Index, Index p, const PlyProperty& property) {
            const std::string_view part = source.peek(property.type);
            numbers_[p] = {part, source.number(property.type)};
            if (const Index column = changes_[p].column; column >= 3 && column < first_field)
                normal_[column - 3] = numbers_[p].value;
        },
        [&](PlySource& source, Index v) { write_vertex(v, source.behind()); });
    splicer_.finish();
    return rounded_;
}

/// Writes vertex v: copies it, with the changed numbers in place of numbers_.
/// @param end the empty piece of the file after the vertex.
void VertexRewriter::write_vertex(Index v, std::string_view end)
{
    const bool is_text = data_.header.encoding == Encoding::Ascii;
    const Point normal = now_.normals ? now_.normals->around_vertex(v, normal_).value_or(normal_) : normal_;
    for (std::size_t p = 0; p < changes_.size(); ++p) {
        const auto [column, type] = changes_[p];
        if (column < 0)
            continue;
        const double after = column < 3             ? now_.positions(v, column)
                             : column < first_field ? normal[column - 3]
                                                    : now_.fields(v, column - first_field);
        if (p >= numbers_.size()) {
            ByteWriter& file = splicer_.exchange(end);
            file.text(is_text ? " " : "");
            write(file, changes_[p], after);
        } else if ((!is_text && type != vertices_.properties[p].type) || differ_as_data(numbers_[p].value, after)) {
            write(splicer_.exchange(numbers_[p].part), changes_[p], after);
        }
    }
}

/// Writes a number in its new type, and sets rounded_ if this rounds a position.
void VertexRewriter::write(ByteWriter& file, const Change& change, double number)
{
    const Encoding encoding = data_.header.encoding;
    const bool is_position = change.column < 3;
    if (is_position && encoding == Encoding::Ascii)
        return file.number(number);
    with_type(change.type, [&](auto zero) {
        const auto stored = stored_as<decltype(zero)>(number);
        if (encoding == Encoding::Ascii)
            file.number(stored);
        else
            file.binary(stored, order_of(encoding));
    });
    const bool single = change.type == PlyType::Float32;
    rounded_ = rounded_ || (is_position && single && double{static_cast<float>(number)} != number);
}

/// The end of a line of the header.
/// @param place a piece of that line.
std::string_view line_end_behind(std::string_view header, std::string_view place)
{
    const std::size_t begin = header.find_first_of("\r\n", static_cast<std::size_t>(place.data() - header.data()));
    return header.substr(begin, header.substr(begin).starts_with("\r\n") ? 2 : 1);
}

/// Writes the header, with wider types where they are necessary, and with new properties.
/// @returns remarks on the wider types.
std::vector<std::string> rewrite_header(ByteWriter& file, const std::filesystem::path& path, std::string_view header,
                                        const PlyElement& vertices, const std::vector<Change>& changes,
                                        const FileFields& fields)
{
    Splicer splicer(file, header);
    std::vector<std::string> remarks;
    const std::size_t n_properties = vertices.properties.size();
    for (std::size_t p = 0; p < n_properties; ++p) {
        const PlyProperty& property = vertices.properties[p];
        if (changes[p].column < 0 || changes[p].type == property.type)
            continue;
        splicer.exchange(property.type_word).text("double");
        remarks.push_back("the type of " + property.name + " is double instead of " + std::string(property.type_word) +
                          ": the type in " + path.string() + " cannot hold the result");
    }
    const std::string_view line_end = line_end_behind(header, vertices.properties.back().type_word);
    // Copies the lines up to the last property of the vertices: the new properties follow it.
    splicer.exchange(line_end).text(line_end);
    for (std::size_t p = n_properties; p < changes.size(); ++p) {
        file.text("property double " + fields.names[changes[p].column - first_field]);
        file.text(line_end);
    }
    splicer.finish();
    return remarks;
}

/// Writes the elements after the header.
/// @returns whether positions were rounded.
bool rewrite_elements(OutputFile& file, const PlyData& data, const std::vector<Change>& changes, const NewVertices& now,
                      const Slicing& slicing)
{
    const std::vector<PlySlice> slices = data.slices(data.up_to(*data.header.element("vertex")), slicing);
    std::vector<std::uint8_t> rounded(slices.size());
    file.slices(static_cast<Index>(slices.size()), slicing.exec, [&](Index i, OutputBuffer& slice) {
        rounded[i] = VertexRewriter(Splicer(slice, slices[i].bytes), data, changes, now).rewrite(slices[i]);
    });
    const std::string_view last = slices.back().bytes;
    file.text({last.data() + last.size(), data.file.data() + data.file.size()});
    return std::ranges::find(rounded, 1) != rounded.end();
}

/// Whether the types of the properties x, y and z can hold the coordinates, floats after rounding.
std::array<bool, 3> coordinates_fit(const PlyElement& vertices, const Points& positions)
{
    std::array<bool, 3> fits{};
    for (std::size_t k = 0; k < fits.size(); ++k) {
        const PlyType type = vertices.property(names_of_columns[k])->type;
        const auto values = positions.col(static_cast<Index>(k));
        fits[k] = reaches(type, values) && (!is_integer(type) || (values.array() == values.array().round()).all());
    }
    return fits;
}

}  // namespace

std::vector<std::string> rewrite_ply(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh, const Slicing& slicing, const FileFields& fields,
                                     double seam_distance)
{
    const PlyData data = ply_data_of(path, content);
    const PlyElement& vertices = *data.header.element("vertex");
    const bool are_given = std::any_of(names_of_columns.begin() + 3, names_of_columns.end(),
                                       [&](std::string_view name) { return fields.column(name) >= 0; });
    const Normals kind = are_given ? Normals::None : normals_of(vertices);
    std::vector<Change> changes =
        changes_of(vertices, coordinates_fit(vertices, mesh.vertices), kind == Normals::Usable);
    std::vector<std::string> remarks = add_fields(changes, vertices, fields, file.path());
    std::optional<MovedNormals> normals;
    // The file has been read: the faults of faces that were accepted then are not reported again.
    FaultLog known_faults{.of_faces_alone = true};
    if (kind == Normals::Usable)
        normals.emplace(mesh, read_ply(path, content, slicing, &known_faults).mesh.vertices, slicing.exec,
                        seam_distance);
    const std::string_view before_elements = content.substr(0, content.size() - data.bytes.size());
    for (std::string& remark : rewrite_header(file, path, before_elements, vertices, changes, fields))
        remarks.push_back(std::move(remark));
    const bool rounded = rewrite_elements(file, data, changes, {mesh.vertices, normals, fields.values}, slicing);
    if (kind == Normals::Other)
        remarks.push_back("the normals of " + path.string() +
                          " are written as they were: they are not three floating-point numbers nx, ny, nz");
    if (rounded)
        remarks.push_back(rounding_remark(path));
    return remarks;
}

}  // namespace seamflow
