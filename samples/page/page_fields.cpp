#include "samples/page/page_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

#include "samples/page/packed_array.h"

namespace seamflow {

namespace {

/// All data of some columns of both states, ascending.
std::vector<double> data_of(std::span<const Eigen::Index> columns, const Eigen::MatrixXd& before,
                            const Eigen::MatrixXd& after)
{
    std::vector<double> data;
    for (const Eigen::MatrixXd* const values : {&before, &after})
        for (const Eigen::Index column : columns)
            if (values->size() > 0)
                std::copy_if(values->col(column).begin(), values->col(column).end(), std::back_inserter(data),
                             [](double value) { return !std::isnan(value); });
    std::sort(data.begin(), data.end());
    return data;
}

/// The value below which that part of the data is.
double quantile(const std::vector<double>& data, double part)
{
    return data.empty() ? 0.0
                        : data[static_cast<std::size_t>(std::lround(part * static_cast<double>(data.size() - 1)))];
}

PageField describe(const std::string& name, std::span<const Eigen::Index> columns, const Eigen::MatrixXd& before,
                   const Eigen::MatrixXd& after)
{
    const std::vector<double> data = data_of(columns, before, after);
    const auto n_values = static_cast<std::size_t>(before.rows() + after.rows()) * columns.size();
    return {.name = name,
            .has_data = !data.empty(),
            .has_gaps = data.size() < n_values,
            .least = quantile(data, 0.0),
            .most = quantile(data, 1.0),
            .percentile_1 = quantile(data, 0.01),
            .percentile_99 = quantile(data, 0.99)};
}

PackedValues pack_column(const PageField& field, Eigen::Index column, const Eigen::MatrixXd& values)
{
    if (values.size() == 0)
        return {};
    // Halves, since the difference of two large numbers may overflow.
    const double half = 0.5 * field.most - 0.5 * field.least;
    std::vector<double> parts;
    for (const double value : values.col(column)) {
        const double part = half > 0.0 ? (0.5 * value - 0.5 * field.least) / half : 0.0;
        parts.push_back(std::isnan(value) ? value : part);
    }
    return pack_values(parts);
}

PackedValues pack_colours(const PageField& field, std::span<const Eigen::Index> columns, const Eigen::MatrixXd& values)
{
    constexpr std::uint8_t grey = 128;
    std::vector<std::uint8_t> bytes;
    for (Eigen::Index v = 0; v < values.rows(); ++v) {
        const bool is_there =
            std::none_of(columns.begin(), columns.end(), [&](Eigen::Index c) { return std::isnan(values(v, c)); });
        for (const Eigen::Index c : columns)
            bytes.push_back(is_there ? static_cast<std::uint8_t>(
                                           std::lround(255.0 * std::clamp(values(v, c) / field.most, 0.0, 1.0)))
                                     : grey);
    }
    return {.data = packed(std::span<const std::uint8_t>(bytes))};
}

/// What files write for full brightness: 1, or the largest whole number of 8 or 16 bits.
double full_brightness(double largest)
{
    return largest > 255.0 ? 65535.0 : largest > 1.0 ? 255.0 : 1.0;
}

}  // namespace

std::vector<PageField> pack_fields(const std::vector<std::string>& names, const Eigen::MatrixXd& before,
                                   const Eigen::MatrixXd& after)
{
    std::vector<PageField> fields;
    const auto column_of = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    const std::array<Eigen::Index, 3> colour = {column_of("red"), column_of("green"), column_of("blue")};
    const auto n_names = static_cast<Eigen::Index>(names.size());
    const bool has_colour = *std::max_element(colour.begin(), colour.end()) < n_names;
    if (has_colour) {
        PageField& field = fields.emplace_back(describe("red, green, blue", colour, before, after));
        field.is_colour = true;
        field.least = 0.0;
        // What files write: after a step that overshoots, more may be left.
        field.most = full_brightness(before.rows() > 0 ? describe("", colour, before, before).most : field.most);
        field.before = pack_colours(field, colour, before);
        field.after = pack_colours(field, colour, after);
    }
    for (Eigen::Index column = 0; column < n_names; ++column) {
        if (has_colour && std::find(colour.begin(), colour.end(), column) != colour.end())
            continue;
        const std::string& name = names[static_cast<std::size_t>(column)];
        PageField& field = fields.emplace_back(describe(name, {&column, 1}, before, after));
        field.before = pack_column(field, column, before);
        field.after = pack_column(field, column, after);
    }
    return fields;
}

}  // namespace seamflow
