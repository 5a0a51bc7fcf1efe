#include "engine/fields/field_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

void require_fields_of(Index n_vertices, const Eigen::MatrixXd& fields)
{
    if (fields.rows() != n_vertices)
        throw InputError(fmt::format("the fields have {} rows, but the mesh has {} vertices: give one for each",
                                     fields.rows(), n_vertices));
    for (Eigen::Index c = 0; c < fields.cols(); ++c)
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            if (std::isinf(fields(v, c)))
                throw InputError(fmt::format("column {} of the fields is infinite at vertex {} (both numbered from 0): "
                                             "give a finite number, or NaN where there are no data",
                                             c, v));
}

std::vector<FieldGroup> group_columns(const Eigen::MatrixXd& fields)
{
    std::vector<FieldGroup> groups;
    std::vector<std::uint8_t> lacks(static_cast<std::size_t>(fields.rows()));
    for (Eigen::Index c = 0; c < fields.cols(); ++c) {
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            lacks[static_cast<std::size_t>(v)] = std::isnan(fields(v, c)) ? 1 : 0;
        auto group = std::ranges::find(groups, lacks, &FieldGroup::lacks);
        if (group == groups.end())
            group = groups.insert(group, {{}, lacks, static_cast<Index>(std::ranges::count(lacks, 1))});
        group->columns.push_back(c);
    }
    return groups;
}

bool is_thin(std::span<const Index> face, const Points& positions)
{
    /// The area over the sum of the squared lengths of the edges.
    constexpr double thinnest = 1e-10;
    double squares = 0.0;
    Index before = face.back();
    for (const Index v : face) {
        squares += (positions.row(v) - positions.row(before)).squaredNorm();
        before = v;
    }
    return !(area(face, positions) > thinnest * squares);
}

bool is_unusable(const PolygonMesh& mesh, Index f, Laplacian laplacian)
{
    return traits_of(laplacian).divisor == Divisor::FaceAreas && is_thin(mesh.face(f), mesh.vertices);
}

std::vector<ValueRange> ranges_of(const Eigen::MatrixXd& fields, const FieldGroup& group, const Executor& exec)
{
    std::vector<ValueRange> ranges(group.columns.size());
    for_each(exec, static_cast<Index>(ranges.size()), [&](Index i) {
        ValueRange range;
        for (Index v = 0; v < static_cast<Index>(fields.rows()); ++v)
            if (group.lacks[v] == 0) {
                range.least = std::min(range.least, fields(v, group.columns[i]));
                range.most = std::max(range.most, fields(v, group.columns[i]));
            }
        ranges[i] = range;
    });
    return ranges;
}

namespace {

/// The limits of the exponent of a unit, within which units and their inverses are normal numbers.
constexpr int least_exponent = -1021;
constexpr int largest_exponent = 1022;

}  // namespace

ScaledFields::ScaledFields(Eigen::MatrixXd values, const FieldGroup& group, std::span<const ValueRange> ranges,
                           double time_step, const Executor& exec)
    : values_(std::move(values))
    , units_(values_.cols())
{
    for_each(exec, static_cast<Index>(values_.cols()), [&](Index c) {
        const auto [least, most] = ranges[c];
        // Halved first, because the difference of the largest numbers would overflow.
        const double half = 0.5 * most - 0.5 * least;
        if (half > 0.0 && std::isfinite(half)) {
            // The unit makes the values of the column spread over about √dt. Steps move positions over about this
            // distance, and steppers, which treat columns like positions, compute updates of this size in single
            // precision.
            const int exponent_of_range = std::ilogb(half) + 1;
            const int exponent_of_move = std::ilogb(std::sqrt(time_step));
            units_[c] =
                std::ldexp(1.0, std::clamp(exponent_of_range - exponent_of_move, least_exponent, largest_exponent));
        } else {
            units_[c] = 1.0;
        }
        for (Index v = 0; v < static_cast<Index>(values_.rows()); ++v)
            values_(v, c) = group.lacks[v] == 0 ? values_(v, c) / units_[c] : 0.0;
    });
}

Eigen::MatrixXd ScaledFields::in_units() const
{
    return (values_.array().rowwise() * units_.transpose().array()).matrix();
}

Eigen::MatrixXd ScaledFields::take(const FieldGroup& group, const Executor& exec)
{
    std::vector<std::uint8_t> is_finite(static_cast<std::size_t>(values_.cols()), 1);
    for_each(exec, static_cast<Index>(values_.cols()), [&](Index c) {
        for (Index v = 0; v < static_cast<Index>(values_.rows()); ++v) {
            values_(v, c) = group.lacks[v] == 0 ? values_(v, c) * units_[c] : std::numeric_limits<double>::quiet_NaN();
            if (group.lacks[v] == 0 && !std::isfinite(values_(v, c)))
                is_finite[c] = 0;
        }
    });
    if (const auto column = std::ranges::find(is_finite, 0); column != is_finite.end())
        throw ComputationError(fmt::format("column {} of the fields (numbered from 0) becomes larger than numbers can "
                                           "be: give it in another unit, or NaN where there are no data",
                                           group.columns[static_cast<std::size_t>(column - is_finite.begin())]));
    return std::move(values_);
}

void keep_within(std::span<const ValueRange> ranges, const FieldGroup& group, Eigen::MatrixXd& fields,
                 const Executor& exec)
{
    for_each(exec, static_cast<Index>(group.columns.size()), [&](Index i) {
        for (Index v = 0; v < static_cast<Index>(fields.rows()); ++v)
            if (double& value = fields(v, group.columns[i]); group.lacks[v] == 0)
                value = std::clamp(value, ranges[i].least, ranges[i].most);
    });
}

int n_blocks(Eigen::Index n_columns)
{
    // As many as positions have coordinates.
    constexpr Eigen::Index columns_of_block = 3;
    return static_cast<int>((n_columns + columns_of_block - 1) / columns_of_block);
}

void add_up(const FlowReport& before, FlowReport& report)
{
    // The columns added before took the same steps, so that their steps must not be counted twice.
    ConvergenceReport& all = report.convergence;
    all.steps_short_of_tolerance = std::max(all.steps_short_of_tolerance, before.convergence.steps_short_of_tolerance);
    all.steps_stagnated = std::max(all.steps_stagnated, before.convergence.steps_stagnated);
    report.seconds.cut += before.seconds.cut;
    report.seconds.analyse += before.seconds.analyse;
    report.seconds.step += before.seconds.step;
    std::vector<Remark> choices = before.choices;
    for (const Remark& choice : report.choices)
        if (std::ranges::find(choices, choice) == choices.end())
            choices.push_back(choice);
    report.choices = std::move(choices);
}

namespace {

/// The beginning of a remark on some columns: "For 'a', 'b' and 'c': ".
std::string about(const std::vector<Eigen::Index>& columns, std::span<const std::string> names)
{
    constexpr std::size_t most_named = 4;
    std::string text = "For ";
    if (names.empty())
        text += columns.size() == 1 ? "column " : "columns ";
    // A single further column is named, too: "and 1 others" takes no less space.
    const std::size_t n_named = columns.size() > most_named + 1 ? most_named : columns.size();
    for (std::size_t i = 0; i < n_named; ++i) {
        text += i == 0 ? "" : i + 1 == columns.size() ? " and " : ", ";
        text += names.empty() ? std::to_string(columns[i]) : in_quotes(names[static_cast<std::size_t>(columns[i])]);
    }
    if (n_named < columns.size())
        text += fmt::format(" and {} others", columns.size() - n_named);
    return text + (names.empty() ? " (numbered from 0): " : ": ");
}

}  // namespace

std::vector<Remark> remarks_on(std::span<const FieldGroup> groups, std::span<const std::vector<Remark>> of_groups,
                               std::span<const std::string> names)
{
    std::vector<Remark> seen;
    std::vector<Remark> remarks;
    for (const std::vector<Remark>& of_group : of_groups)
        for (const Remark& remark : of_group) {
            if (std::ranges::find(seen, remark) != seen.end())
                continue;
            seen.push_back(remark);
            std::vector<Eigen::Index> columns;
            bool is_on_all = true;
            for (std::size_t g = 0; g < groups.size(); ++g) {
                const bool is_on_group = std::ranges::find(of_groups[g], remark) != of_groups[g].end();
                is_on_all = is_on_all && is_on_group;
                if (is_on_group)
                    columns.insert(columns.end(), groups[g].columns.begin(), groups[g].columns.end());
            }
            std::ranges::sort(columns);
            remarks.push_back(remark);
            if (!is_on_all)
                remarks.back().wording.text.insert(0, unmarked(about(columns, names)).text);
        }
    return remarks;
}

}  // namespace seamflow
