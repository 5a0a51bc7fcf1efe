#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_header.h"
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

Eigen::MatrixXd read_columns(const PlyVertexSlices& slices, const PlyHeader& header, const FileFields& fields,
                             const Executor& exec)
{
    const PlyElement& vertices = *header.element("vertex");
    const std::vector<ReadProperty> properties = properties_to_read(vertices, fields);
    Eigen::MatrixXd values(static_cast<Index>(vertices.count), static_cast<Index>(fields.names.size()));
    for_each(exec, slices.count(), [&](Index i) {
        slices.with_source(i, [&](auto& source) {
            for_each_vertex(source, header, slices[i], [&](Index v) {
                source.begin_element(vertices, at(v));
                for (const auto& [property, column, name] : properties)
                    if (column < 0)
                        pass_over(source, property);
                    else
                        values(v, column) = source.field(property.type, name.c_str());
                source.end_element();
            });
        });
    });
    return values;
}

}  // namespace

FileFields read_ply_fields(const std::filesystem::path& path, std::string_view content,
                           std::span<const std::string> names, const Slicing& slicing)
{
    TextScanner scanner(path, content, ply_syntax);
    const PlyHeader header = read_ply_header(scanner);
    const PlyElement& vertices = *header.element("vertex");
    FileFields fields{
        names_of_fields(path, names, [&](std::string_view name) { return vertices.property(name) != nullptr; })};
    for (const std::string& name : fields.names)
        require_number(scanner, vertices, name);
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
