#include "samples/report/rank_report.h"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "partition/io/input_position.h"
#include "samples/report/json_parts.h"
#include "samples/report/smoothing_request.h"

namespace seamflow {

namespace {

using Json = ReportJson;

double seconds_of_steps(const RankReport& report)
{
    double seconds = 0.0;
    for (const RankStepReport& step : report.steps)
        seconds += step.seconds;
    return seconds;
}

/// "12" or "10 to 12".
template <class Value>
std::string range_of(const std::vector<RankRecord>& ranks, Value RankRecord::*member)
{
    const auto [least, most] = std::ranges::minmax_element(ranks, {}, member);
    return (*least).*member == (*most).*member ? fmt::format("{}", (*most).*member)
                                               : fmt::format("{} to {}", (*least).*member, (*most).*member);
}

Json step_json(const RankStepReport& step, double mean_edge)
{
    Json json{{"seconds", step.seconds}};
    if (step.measures)
        add_statistics(json, "moved", step.measures->displacement, mean_edge);
    if (step.iterations)
        json["iterations"] = *step.iterations;
    if (step.residual)
        json["residual"] = *step.residual;
    if (step.estimated_v_max)
        json["estimated_v_max"] = *step.estimated_v_max;
    return json;
}

}  // namespace

void print_rank_step(std::ostream& out, const RankStepState& state, int steps, double mean_edge)
{
    const RankStepReport& report = state.report;
    const double edge = mean_edge > 0.0 ? mean_edge : 1.0;
    out << fmt::format("step {} of {}  {:.3f} s", state.step, steps, report.seconds);
    if (report.measures)
        out << fmt::format("  moved {:.3g}", report.measures->displacement.mean / edge);
    if (report.iterations)
        out << fmt::format("  iterations {}, residual {:.2g}", *report.iterations, report.residual.value_or(0.0));
    if (report.estimated_v_max)
        out << fmt::format("  estimated distance to the undecomposed flow {:.2g} mean edge lengths",
                           *report.estimated_v_max);
    out << std::endl;
}

void print_distributed_result(std::ostream& out, const DistributedRecord& record)
{
    const RankReport& report = record.report;
    for (std::size_t i = 0; i < record.choices.size(); ++i)
        out << (i == 0 ? "chosen     " : " ") << record.choices[i] << (i + 1 == record.choices.size() ? "\n" : "");
    out << fmt::format("cut        {} in {}, {}; {} of {} vertices{}\n",
                       counted(report.sub_meshes, "sub-mesh", "sub-meshes"),
                       counted(report.colours, "colour", "colours"),
                       counted(report.interface_vertices, "interface vertex", "interface vertices"),
                       counted(record.ranks.size(), "rank", "ranks"), range_of(record.ranks, &RankRecord::vertices),
                       record.ranks.size() == 1 ? "" : " each");
    const auto largest = std::ranges::max(record.ranks, {}, &RankRecord::peak_memory_bytes).peak_memory_bytes;
    out << fmt::format(
        "time       {:.3g} s: read {:.3f}, set-up {:.3f}, steps {:.3f}, write {:.3f}; threads of a rank: {}, MB at "
        "most: {:.4g}\n",
        record.run.seconds, record.run.read_seconds, record.setup_seconds, seconds_of_steps(report),
        record.run.write_seconds, range_of(record.ranks, &RankRecord::threads), static_cast<double>(largest) / 1e6);
    for (const std::string& remark : record.remarks)
        out << "remark     " << remark << '\n';
    const double edge = record.size.mean_edge > 0.0 ? record.size.mean_edge : 1.0;
    const SurfaceLook& before = record.run.surface.before;
    const SurfaceLook& after = record.run.surface.after;
    const LengthStatistics& moved = record.run.surface.moved;
    out << fmt::format(
        "result     {}: moved {:.3g} mean edge lengths on average, {:.3g} at most; roughness {:.3g} -> {:.3g} degrees, "
        "area {:.6g} -> {:.6g}",
        record.run.output, moved.mean / edge, moved.max / edge, before.roughness.rms, after.roughness.rms, before.area,
        after.area);
    if (before.volume && after.volume)
        out << fmt::format(", volume {:.6g} -> {:.6g}", *before.volume, *after.volume);
    if (!report.steps.empty() && report.steps.back().estimated_v_max.value_or(0.0) > 0.0)
        out << fmt::format("; by estimate {:.2g} mean edge lengths at most from the undecomposed flow",
                           *report.steps.back().estimated_v_max);
    out << std::endl;
}

std::string distributed_report_json(const DistributedRecord& record, const FlowOptions& options)
{
    const RunRecord& run = record.run;
    const RankReport& report = record.report;
    Json json = begin_report(run);
    json["vertices"] = record.size.vertices;
    json["faces"] = record.size.faces;
    json["mean_edge"] = record.size.mean_edge;
    json["diagonal"] = record.size.diagonal;
    json["subdomains"] = report.sub_meshes;
    json["colours"] = report.colours;
    json["interface_vertices"] = report.interface_vertices;
    json["non_manifold_vertices"] = report.non_manifold_vertices;
    json["laplacian"] = run.laplacian;
    json["flow"] = option_name(run.flow);
    json["filter"] = option_name(run.filter.kind);
    json["order"] = run.filter.order;
    if (run.attachment)
        json["attachment"] = *run.attachment;
    json["attachment_weights"] = run.has_attachment_weights;
    json["time_step"] = record.time_step;
    json["time_step_edges"] = record.time_step / (record.size.mean_edge * record.size.mean_edge);
    json["radius"] = smoothed_radius(record.time_step, std::max(options.steps, 1), filter_of(options));
    json["approach"] = option_name(options.accuracy.approach);
    if (report.convergence.tolerance) {
        json["tolerance"] = *report.convergence.tolerance;
        json["steps_short_of_tolerance"] = report.convergence.steps_short_of_tolerance;
        json["steps_stagnated"] = report.convergence.steps_stagnated;
    }
    json["seconds"] = {{"read", run.read_seconds},
                       {"setup", record.setup_seconds},
                       {"step", seconds_of_steps(report)},
                       {"write", run.write_seconds},
                       {"total", run.seconds}};
    json["steps"] = Json::array();
    for (const RankStepReport& step : report.steps)
        json["steps"].push_back(step_json(step, record.size.mean_edge));
    json["ranks"] = Json::array();
    for (const RankRecord& rank : record.ranks)
        json["ranks"].push_back({{"vertices", rank.vertices},
                                 {"foreign_vertices", rank.foreign_vertices},
                                 {"messages", rank.messages},
                                 {"bytes", rank.bytes},
                                 {"threads", rank.threads},
                                 {"peak_memory_bytes", rank.peak_memory_bytes}});
    json["surface"] = {{"before", look_json(run.surface.before)}, {"after", look_json(run.surface.after)}};
    add_statistics(json["surface"], "moved", run.surface.moved, record.size.mean_edge);
    json["choices"] = record.choices;
    json["remarks"] = record.remarks;
    return text_of(json);
}

}  // namespace seamflow
