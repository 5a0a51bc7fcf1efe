#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_source.h"
#include "partition/formats/ply_vertices.h"

namespace seamflow {

namespace {

/// A property of the vertices, and where its numbers go.
struct ReadProperty {
    const PlyProperty& property;
    /// -1: it is passed over.
    Index column;
    /// In messages.
    std::string name;
};

std::vector<ReadProperty> properties_to_read(const PlyElement& vertices, const FileFields& fields)
{
    std::vector<ReadProperty> properties;
    for (const PlyProperty& property : vertices.properties)
        properties.push_back({property, fields.column(property.name), "the number " + in_quotes(property.name)});
    return properties;
}

/// Reads the numbers of vertex v of the file into a row.
template <class Source>
void read_row(Source& source, const PlyElement& vertices, Index v, const std::vector<ReadProperty>& properties,
              auto&& row)
{
    source.begin_element(vertices, at(v));
    for (const auto& [property, column, name] : properties)
        if (column < 0)
            pass_over(source, property);
        else
            row(column) = source.field(property.type, name.c_str());
    source.end_element();
}

Eigen::MatrixXd read_columns(const PlyVertexSlices& slices, const PlyHeader& header, const FileFields& fields,
                             const Executor& exec)
{
    const PlyElement& vertices = *header.element("vertex");
    const std::vector<ReadProperty> properties = properties_to_read(vertices, fields);
    Eigen::MatrixXd values(static_cast<Index>(vertices.count), static_cast<Index>(fields.names.size()));
    for_each(exec, slices.count(), [&](Index i) {
        slices.with_source(i, [&](auto& source) {
            for_each_vertex(source, header, slices[i],
                            [&](Index v) { read_row(source, vertices, v, properties, values.row(v)); });
        });
    });
    return values;
}

std::optional<WholeRange> whole_range_of(PlyType type)
{
    if (!is_integer(type))
        return {};
    return with_type(type, [](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return WholeRange{static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max())};
    });
}

/// Fields of a file, without values.
/// @throws InputError for names that it does not have.
FileFields find_fields(const TextScanner& scanner, const std::filesystem::path& path, const PlyHeader& header,
                       std::span<const std::string> names)
{
    const PlyElement& vertices = *header.element("vertex");
    FileFields fields{
        names_of_fields(path, names, [&](std::string_view name) { return vertices.property(name) != nullptr; })};
    for (const std::string& name : fields.names) {
        require_number(scanner, vertices, name);
        const PlyType type = vertices.property(name)->type;
        fields.whole.push_back(whole_range_of(type));
        fields.decimals.push_back(decimals_of(type, header.encoding));
    }
    return fields;
}

}  // namespace

Decimals decimals_of(PlyType type, Encoding encoding)
{
    if (type != PlyType::Float32)
        return Decimals::Double;
    return encoding == Encoding::Ascii ? Decimals::SingleText : Decimals::Single;
}

FileFields read_ply_fields(const std::filesystem::path& path, std::string_view content,
                           std::span<const std::string> names, const Slicing& slicing)
{
    TextScanner scanner(path, content, ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    FileFields fields = find_fields(scanner, path, header, names);
    const auto read = [&](const Slicing& sliced) {
        return read_columns({path, content, header, scanner, sliced}, header, fields, sliced.exec);
    };
    fields.values = read_in_slices_if_faultless([&] { return read(slicing); },
                                                [&] {
                                                    return read({run_serially, content.size()});
                                                });
    return fields;
}

}  // namespace seamflow
