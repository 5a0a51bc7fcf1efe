#include "samples/report/field_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include <fmt/format.h>

#include "partition/io/input_position.h"
#include "samples/report/json_parts.h"

namespace seamflow {

namespace {

/// Of the vertices with data.
struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    double mean = 0.0;
    Index n = 0;
};

Range range_of(const Eigen::MatrixXd& values, Eigen::Index column)
{
    Range range;
    for (Eigen::Index v = 0; v < values.rows(); ++v) {
        const double value = values(v, column);
        if (std::isnan(value))
            continue;
        range.least = std::min(range.least, value);
        range.most = std::max(range.most, value);
        range.mean += value;
        ++range.n;
    }
    range.mean /= std::max(range.n, Index{1});
    return range;
}

std::string text_of(const Range& range)
{
    return range.n == 0 ? "no data" : fmt::format("{:.6g} to {:.6g}, mean {:.6g}", range.least, range.most, range.mean);
}

ReportJson json_of(const Range& range)
{
    ReportJson json;
    json["vertices"] = range.n;
    if (range.n > 0) {
        json["least"] = range.least;
        json["most"] = range.most;
        json["mean"] = range.mean;
    }
    return json;
}

}  // namespace

void print_field_amount(std::ostream& out, const MeshScale& scale, const FlowOptions& options,
                        const FieldOptions& of_fields)
{
    out << fmt::format("amount     {} of {:.6g} squared mean edge lengths (dt {:.6g})",
                       counted(options.steps, "step", "steps"), options.time_step / (scale.mean_edge * scale.mean_edge),
                       options.time_step);
    const double time = options.time_step * options.steps;
    if (filter_of(options).is_plain() && options.steps > 0)
        out << fmt::format(": a kernel {:.6g} wide at half its height", of_fields.fwhm.value_or(fwhm_for_time(time)));
    if (of_fields.keep_edges)
        out << fmt::format(", differences above {:g} kept", *of_fields.keep_edges);
    out << std::endl;
}

void print_fields(std::ostream& out, const RunRecord& run, const FieldSummary& summary)
{
    const FieldReport& report = summary.report;
    for (std::size_t i = 0; i < report.flow.choices.size(); ++i)
        out << (i == 0 ? "chosen     " : " ") << report.flow.choices[i]
            << (i + 1 == report.flow.choices.size() ? "\n" : "");
    const PhaseSeconds& phases = report.flow.seconds;
    out << fmt::format("time       {:.3g} s: read {:.3f}, set-up {:.3f}, steps {:.3f}, write {:.3f}; {:.4g} MB\n",
                       run.seconds, run.read_seconds, phases.cut + phases.analyse, phases.step, run.write_seconds,
                       static_cast<double>(peak_memory_of(run)) / 1e6);
    for (const std::string& remark : report.remarks)
        out << "remark     " << remark << '\n';
    if (report.without_data > 0)
        out << fmt::format("no data    at {}{}\n",
                           counted(static_cast<std::uint64_t>(report.without_data), "vertex", "vertices"),
                           report.filled > 0 ? fmt::format(", of which {} were filled", report.filled) : "");
    if (report.fwhm)
        out << fmt::format("width      {:.6g} at half maximum, as white noise shows that diffused alike\n",
                           *report.fwhm);
    for (std::size_t c = 0; c < summary.names.size(); ++c) {
        const auto column = static_cast<Eigen::Index>(c);
        out << fmt::format("field      {}: ", summary.names[c]);
        if (summary.before.size() > 0)
            out << text_of(range_of(summary.before, column)) << " -> ";
        out << text_of(range_of(summary.after, column)) << '\n';
    }
    out << "result     " << run.output << std::endl;
}

std::string field_report_json(const RunRecord& run, const FlowOptions& options, const FieldSummary& summary)
{
    const FieldReport& report = summary.report;
    ReportJson json = begin_report(run);
    json["vertices"] = summary.after.rows();
    if (summary.before.size() > 0) {
        json["laplacian"] = run.laplacian;
        json["steps"] = options.steps;
        json["time_step"] = options.time_step;
    }
    if (report.fwhm)
        json["fwhm"] = *report.fwhm;
    json["without_data"] = report.without_data;
    json["filled"] = report.filled;
    for (std::size_t c = 0; c < summary.names.size(); ++c) {
        ReportJson field;
        const auto column = static_cast<Eigen::Index>(c);
        if (summary.before.size() > 0)
            field["before"] = json_of(range_of(summary.before, column));
        field["after"] = json_of(range_of(summary.after, column));
        json["fields"][summary.names[c]] = field;
    }
    const PhaseSeconds& phases = report.flow.seconds;
    json["seconds"] = {{"read", run.read_seconds},
                       {"setup", phases.cut + phases.analyse},
                       {"step", phases.step},
                       {"write", run.write_seconds},
                       {"total", run.seconds}};
    json["choices"] = report.flow.choices;
    json["remarks"] = report.remarks;
    return text_of(json);
}

}  // namespace seamflow
