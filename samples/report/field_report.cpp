#include "samples/report/field_report.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "partition/executor.h"
#include "partition/text.h"
#include "samples/report/report_json.h"
#include "samples/report/report_text.h"

namespace seamflow {

namespace {

/// See FieldRange::small_sum.
constexpr int exponent_of_small_sums = 64;

std::string text_of(const FieldRange& range)
{
    return range.n == 0 ? "no data"
                        : fmt::format("{:.6g} to {:.6g}, mean {:.6g}", range.least, range.most, range.mean());
}

ReportJson json_of(const FieldRange& range)
{
    ReportJson json;
    json["vertices"] = range.n;
    if (range.n > 0) {
        json["least"] = range.least;
        json["most"] = range.most;
        json["mean"] = range.mean();
    }
    return json;
}

/// The names as keys of JSON, in which all bytes that are not UTF-8 look alike: a number behind the later of two alike
/// tells them apart, which no name has, as it is one word.
std::vector<std::string> keys_of(const std::vector<std::string>& names)
{
    std::vector<std::string> keys;
    for (const std::string& name : names) {
        const std::string shown = ReportJson::parse(seamflow::text_of(ReportJson(name))).get<std::string>();
        std::string key = shown;
        for (int n = 2; std::ranges::find(keys, key) != keys.end(); ++n)
            key = fmt::format("{} ({})", shown, n);
        keys.push_back(key);
    }
    return keys;
}

}  // namespace

void FieldRange::add(const FieldRange& other)
{
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    sum += other.sum;
    small_sum += other.small_sum;
    n += other.n;
}

double FieldRange::mean() const
{
    const auto divisor = static_cast<double>(std::max(n, std::int64_t{1}));
    return std::isfinite(sum) ? sum / divisor : std::ldexp(small_sum / divisor, exponent_of_small_sums);
}

std::vector<FieldRange> ranges_of_columns(const Eigen::MatrixXd& values)
{
    std::vector<FieldRange> ranges;
    for (Eigen::Index c = 0; c < values.cols(); ++c)
        ranges.push_back(reduce(
            run_serially, static_cast<Index>(values.rows()), FieldRange{},
            [&](FieldRange& range, Index v) {
                if (const double value = values(v, c); !std::isnan(value))
                    range.add({value, value, value, std::ldexp(value, -exponent_of_small_sums), 1});
            },
            [](FieldRange& range, const FieldRange& block) { range.add(block); }));
    return ranges;
}

void print_field_amount(std::ostream& out, const MeshScale& scale, const FlowOptions& options,
                        const FieldOptions& of_fields)
{
    out << fmt::format("amount     {} of {:.6g} squared mean edge lengths (dt {:.6g})",
                       counted(options.steps, "step", "steps"), options.time_step / (scale.mean_edge * scale.mean_edge),
                       options.time_step);
    const double time = options.time_step * options.steps;
    const bool is_of_surface = traits_of(options.laplacian).reach != Reach::Edges;
    if (filter_of(options).is_plain() && options.steps > 1 && is_of_surface)
        out << fmt::format(": white noise becomes {:.6g} wide at half its height",
                           of_fields.fwhm ? of_fields.fwhm->value : fwhm_for_time(time, options));
    if (of_fields.keep_edges)
        out << fmt::format(", differences above {:g} kept", *of_fields.keep_edges);
    out << std::endl;
}

void print_fields(std::ostream& out, const RunRecord& run, const FieldSummary& summary)
{
    const FieldReport& report = summary.report;
    print_choices(out, run.choices_in_words);
    out << fmt::format("{}; {:.4g} MB\n", time_of(run, report.flow.seconds),
                       static_cast<double>(peak_memory_of(run)) / 1e6);
    print_remarks(out, run.remarks_in_words);
    if (report.without_data > 0)
        out << fmt::format("no data    at {}{}\n",
                           counted(static_cast<std::uint64_t>(report.without_data), "vertex", "vertices"),
                           report.filled > 0 ? fmt::format(", of which {} were filled", report.filled) : "");
    if (report.fwhm)
        out << fmt::format("width      {:.6g} at half maximum, as white noise shows that diffused alike\n",
                           *report.fwhm);
    for (std::size_t c = 0; c < summary.names.size(); ++c) {
        out << fmt::format("field      {}: ", summary.names[c]);
        if (!summary.before.empty())
            out << text_of(summary.before[c]) << " -> ";
        out << text_of(summary.after[c]) << '\n';
    }
    out << "result     " << run.output << std::endl;
}

std::string field_report_json(const RunRecord& run, const FlowOptions& options, const FieldSummary& summary)
{
    const FieldReport& report = summary.report;
    ReportJson json = begin_report(run);
    json["vertices"] = summary.n_vertices;
    if (!summary.before.empty()) {
        json["laplacian"] = name_of(options.laplacian);
        json["steps"] = options.steps;
        json["time_step"] = options.time_step;
        add_convergence(json, report.flow.convergence);
    }
    if (report.fwhm)
        json["fwhm"] = *report.fwhm;
    json["without_data"] = report.without_data;
    json["filled"] = report.filled;
    const std::vector<std::string> keys = keys_of(summary.names);
    for (std::size_t c = 0; c < keys.size(); ++c) {
        ReportJson field;
        if (!summary.before.empty())
            field["before"] = json_of(summary.before[c]);
        field["after"] = json_of(summary.after[c]);
        json["fields"][keys[c]] = field;
    }
    const PhaseSeconds& phases = report.flow.seconds;
    json["seconds"] = {{"read", run.read_seconds},
                       {"setup", phases.cut + phases.analyse},
                       {"step", phases.step},
                       {"write", run.write_seconds},
                       {"total", run.seconds}};
    json["choices"] = remarks_json(run.choices_in_words);
    json["remarks"] = remarks_json(run.remarks_in_words);
    add_ranks(json, run.ranks);
    return text_of(json);
}

}  // namespace seamflow
