#include "partition/formats/file_fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "partition/text.h"

namespace seamflow {

namespace {

bool is_axis(std::string_view name)
{
    return name == "x" || name == "y" || name == "z";
}

bool is_one_word(std::string_view name)
{
    return !name.empty() &&
           std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '\x7f'; });
}

/// The names of the fields that a word stands for; the word itself if it is no group of fields.
std::vector<std::string> fields_meant_by(const std::string& word)
{
    if (word == "normal")
        return {"nx", "ny", "nz"};
    if (word == "colour" || word == "color")
        return {"red", "green", "blue"};
    return {word};
}

bool fits_in_single_precision(const auto& values)
{
    return std::ranges::none_of(
        values, [](double value) { return std::abs(value) > double{std::numeric_limits<float>::max()}; });
}

/// The value that is read back after `value` has been written in single precision.
/// @param decimals Single or SingleText.
double in_single_precision(double value, Decimals decimals)
{
    const auto single = static_cast<float>(value);
    double read = single;
    if (decimals == Decimals::SingleText && std::isfinite(value)) {
        std::array<char, 32> text{};
        const char* const end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
        std::from_chars(text.data(), end, read);
    }
    return read;
}

/// Checks that each name is one word, no coordinate, and occurs once.
void require_good_names(const std::filesystem::path& path, const FileFields& fields)
{
    const auto refuse = [&](const std::string& name, const char* why) {
        throw OutputError(fmt::format("{}: cannot be written: the field {} {}", path.string(), in_quotes(name), why));
    };
    std::set<std::string_view> names;
    for (const std::string& name : fields.names) {
        if (!is_one_word(name))
            refuse(name, "must have a name of one word; name it with letters, digits and underscores");
        if (is_axis(name))
            refuse(name, "is a coordinate; change the positions of the mesh, or give the field another name");
        if (!names.insert(name).second)
            refuse(name, "is there twice; leave one out");
    }
}

}  // namespace

Index FileFields::column(std::string_view name) const
{
    const auto found = std::ranges::find(names, name);
    return found != names.end() ? static_cast<Index>(found - names.begin()) : -1;
}

void round_as_written(FileFields& fields, const Eigen::MatrixXd& extremes, const Executor& exec)
{
    const auto round_column = [&](Eigen::Index c, auto&& rounded) {
        for_each(exec, static_cast<Index>(fields.values.rows()),
                 [&](Index v) { fields.values(v, c) = rounded(fields.values(v, c)); });
    };
    for (Eigen::Index c = 0; c < fields.values.cols(); ++c) {
        const auto column = static_cast<std::size_t>(c);
        if (const auto range = column < fields.whole.size() ? fields.whole[column] : std::nullopt)
            // Adding 0 turns -0 into 0.
            round_column(
                c, [&](double value) { return std::clamp(std::round(value), range->least, range->largest) + 0.0; });
        else if (column < fields.decimals.size() && fields.decimals[column] != Decimals::Double &&
                 fits_in_single_precision(extremes.col(c)))
            round_column(c, [&](double value) { return in_single_precision(value, fields.decimals[column]); });
    }
}

std::vector<std::string> names_of_fields(const std::filesystem::path& path, std::span<const std::string> names,
                                         const std::function<bool(std::string_view name)>& is_there)
{
    std::vector<std::string> all;
    for (const std::string& name : names) {
        if (is_axis(name))
            throw InputError(fmt::format("{}: {} is a coordinate of the positions, not a field; name another property",
                                         path.string(), in_quotes(name)));
        for (const std::string& field : is_there(name) ? std::vector{name} : fields_meant_by(name))
            add_once(all, field);
    }
    return all;
}

void require_writable(const std::filesystem::path& path, const FileFields& fields, Index n_vertices,
                      const Executor& exec)
{
    require_good_names(path, fields);
    const auto n_fields = static_cast<Index>(fields.names.size());
    if (fields.values.cols() != n_fields || (n_fields > 0 && fields.values.rows() != n_vertices))
        throw OutputError(fmt::format("{}: cannot be written: there are {} by {} values for {} vertices and {} fields; "
                                      "give a row for each vertex and a column for each name",
                                      path.string(), fields.values.rows(), fields.values.cols(), n_vertices, n_fields));
    for (Index column = 0; column < n_fields; ++column) {
        const auto infinite = select(exec, n_vertices, [&](Index v) { return std::isinf(fields.values(v, column)); });
        if (!infinite.empty())
            throw OutputError(fmt::format("{}: cannot be written: the field {} of vertex {} (numbered from 0) is "
                                          "infinite; give a finite number, or NaN where there is none",
                                          path.string(), in_quotes(fields.names[column]), infinite.front()));
    }
}

}  // namespace seamflow
