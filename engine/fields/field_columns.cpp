#include "engine/fields/field_columns.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "engine/fields/thin_faces.h"
#include "partition/errors.h"
#include "partition/io/input_position.h"

namespace seamflow {

void require_fields_of(Index n_vertices, const Eigen::MatrixXd& fields, std::span<const std::int64_t> numbers)
{
    if (fields.rows() != n_vertices)
        throw InputError(fmt::format("the fields have {} rows, but the mesh has {} vertices: give one for each",
                                     fields.rows(), n_vertices));
    for (Eigen::Index c = 0; c < fields.cols(); ++c)
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            if (std::isinf(fields(v, c)))
                throw InputError(fmt::format("column {} of the fields is infinite at vertex {} (both numbered from 0): "
                                             "give a finite number, or NaN where there are no data",
                                             c, numbers.empty() ? v : numbers[static_cast<std::size_t>(v)]));
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

bool is_unusable(const PolygonMesh& mesh, Index f, Laplacian laplacian)
{
    return traits_of(laplacian).divisor == Divisor::FaceAreas && is_thin(mesh.face(f), mesh.vertices);
}

bool has_data(const PolygonMesh& mesh, Index f, const FieldGroup& group, Laplacian laplacian)
{
    return std::ranges::all_of(mesh.face(f), [&](Index v) { return group.lacks[v] == 0; }) &&
           !is_unusable(mesh, f, laplacian);
}

std::vector<ValueRange> ranges_of(const Eigen::MatrixXd& fields, const FieldGroup& group)
{
    std::vector<ValueRange> ranges;
    for (const Eigen::Index c : group.columns) {
        ValueRange& range = ranges.emplace_back();
        for (Eigen::Index v = 0; v < fields.rows(); ++v)
            if (group.lacks[static_cast<std::size_t>(v)] == 0) {
                range.least = std::min(range.least, fields(v, c));
                range.most = std::max(range.most, fields(v, c));
            }
    }
    return ranges;
}

namespace {

/// Of the units, so that these and their inverses are normal numbers.
constexpr int least_exponent = -1021;
constexpr int largest_exponent = 1022;

/// @throws ComputationError
double finite(double value, Eigen::Index column)
{
    if (!std::isfinite(value))
        throw ComputationError(fmt::format("column {} of the fields (numbered from 0) becomes larger than numbers can "
                                           "be: give it in another unit, or NaN where there are no data",
                                           column));
    return value;
}

}  // namespace

ScaledFields::ScaledFields(const Eigen::MatrixXd& fields, const FieldGroup& group, std::span<const ValueRange> ranges,
                           double time_step)
    : values_(fields(Eigen::all, group.columns))
    , units_(values_.cols())
{
    for (Eigen::Index v = 0; v < values_.rows(); ++v)
        if (group.lacks[static_cast<std::size_t>(v)] != 0)
            values_.row(v).setZero();
    for (Eigen::Index c = 0; c < values_.cols(); ++c) {
        const auto [least, most] = ranges[static_cast<std::size_t>(c)];
        // Halved, even the spread of the largest numbers is one.
        const double half = 0.5 * most - 0.5 * least;
        units_[c] = half > 0.0 && std::isfinite(half)
                        ? std::ldexp(1.0, std::clamp(std::ilogb(half) + 1 - std::ilogb(std::sqrt(time_step)),
                                                     least_exponent, largest_exponent))
                        : 1.0;
    }
    values_.array().rowwise() /= units_.transpose().array();
}

Eigen::MatrixXd ScaledFields::in_units() const
{
    return (values_.array().rowwise() * units_.transpose().array()).matrix();
}

void ScaledFields::write(const FieldGroup& group, Eigen::MatrixXd& fields) const
{
    const Eigen::MatrixXd results = in_units();
    for (Eigen::Index v = 0; v < fields.rows(); ++v)
        for (std::size_t c = 0; group.lacks[static_cast<std::size_t>(v)] == 0 && c < group.columns.size(); ++c)
            fields(v, group.columns[c]) = finite(results(v, static_cast<Eigen::Index>(c)), group.columns[c]);
}

int n_blocks(Eigen::Index n_columns)
{
    return static_cast<int>((n_columns + 2) / 3);
}

void add_up(const FlowReport& before, FlowReport& report)
{
    // Other columns take the same steps.
    ConvergenceReport& all = report.convergence;
    all.steps_short_of_tolerance = std::max(all.steps_short_of_tolerance, before.convergence.steps_short_of_tolerance);
    all.steps_stagnated = std::max(all.steps_stagnated, before.convergence.steps_stagnated);
    report.seconds.cut += before.seconds.cut;
    report.seconds.analyse += before.seconds.analyse;
    report.seconds.step += before.seconds.step;
    for (std::vector<std::string> FlowReport::*const list : {&FlowReport::choices, &FlowReport::remarks}) {
        std::vector<std::string> sentences = before.*list;
        for (const std::string& sentence : report.*list)
            add_once(sentences, sentence);
        report.*list = std::move(sentences);
    }
}

}  // namespace seamflow
