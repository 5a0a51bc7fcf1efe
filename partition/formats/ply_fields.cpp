#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/formats/ply.h"
#include "partition/formats/ply_data.h"
#include "partition/formats/ply_header.h"
#include "partition/formats/ply_source.h"

namespace seamflow {

namespace {

/// Reads the values of the fields: #V by names, NaN where a vertex has no data.
Eigen::MatrixXd read_columns(const PlyData& data, const FileFields& fields, const Slicing& slicing)
{
    const PlyElement& vertices = *data.header.element("vertex");
    const std::vector<Index> columns =
        columns_of(vertices, [&](const PlyProperty& property) { return fields.column(property.name); });
    const std::vector<PlySlice> slices = data.slices(data.up_to(vertices), slicing);
    std::vector<std::string> words;
    for (const std::string& name : fields.names)
        words.push_back(fmt::format("the number {}", in_quotes(name)));
    Eigen::MatrixXd values(static_cast<Index>(vertices.count), static_cast<Index>(words.size()));
    for_each(slicing.exec, static_cast<Index>(slices.size()), [&](Index i) {
        data.scan(
            slices[i], vertices, columns,
            [&](PlySource& source, Index v, Index column, const PlyProperty& property) {
                values(v, column) = source.field(property.type, words[column].c_str());
            },
            [](PlySource&, Index) {});
    });
    return values;
}

/// The range of a type of whole numbers; nothing for other types.
std::optional<WholeRange> whole_range_of(PlyType type)
{
    if (!is_integer(type))
        return {};
    return with_type(type, [](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return WholeRange{static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max())};
    });
}

/// The fields of a file, without values.
/// @throws InputError for names that the file does not have.
FileFields find_fields(const PlyData& data, std::span<const std::string> names)
{
    const PlyElement& vertices = *data.header.element("vertex");
    FileFields fields{
        names_of_fields(data.path, names, [&](std::string_view name) { return vertices.property(name) != nullptr; })};
    for (const std::string& name : fields.names) {
        if (const PlyElement* const faces = data.header.element("face");
            vertices.property(name) == nullptr && faces != nullptr && faces->property(name) != nullptr)
            throw InputError(fmt::format(
                "{}: {} is a property of the faces, but fields are of the vertices: give each vertex the mean of "
                "its faces, or name a property of the vertices",
                data.path.string(), in_quotes(name)));
        require_number(data.after_header, vertices, name);
        const PlyType type = vertices.property(name)->type;
        fields.whole.push_back(whole_range_of(type));
        fields.decimals.push_back(decimals_of(type, data.header.encoding));
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
    const PlyData data = ply_data_of(path, content);
    FileFields fields = find_fields(data, names);
    fields.values = read_in_slices_if_faultless([&] { return read_columns(data, fields, slicing); },
                                                [&] {
                                                    return read_columns(data, fields, {run_serially, content.size()});
                                                });
    return fields;
}

}  // namespace seamflow
