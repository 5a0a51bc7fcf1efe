#include "samples/common/report_json.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "engine/setup/smoothing_amount.h"
#include "samples/common/peak_memory.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const std::vector<double>& values)
{
    Json list = Json::array();
    for (const double value : values)
        list.push_back(number(value));
    return list;
}

void add_distance(Json& json, const VertexDistance& distance)
{
    json["v_mean"] = number(distance.mean / distance.mean_edge);
    json["v_rms"] = number(distance.rms / distance.mean_edge);
    json["v_max"] = number(distance.max / distance.mean_edge);
    json["v_mean_absolute"] = number(distance.mean);
    json["v_rms_absolute"] = number(distance.rms);
    json["v_max_absolute"] = number(distance.max);
    json["mean_edge"] = number(distance.mean_edge);
}

/// In units of `unit`.
void add_relative(Json& json, const std::string& name, const LengthStatistics& lengths, double unit)
{
    json[name + "_mean"] = number(lengths.mean / unit);
    json[name + "_rms"] = number(lengths.rms / unit);
    json[name + "_max"] = number(lengths.max / unit);
}

/// In units of `mean_edge`, and in units of length.
void add_statistics(Json& json, const std::string& name, const LengthStatistics& lengths, double mean_edge)
{
    add_relative(json, name, lengths, mean_edge);
    json[name + "_mean_absolute"] = number(lengths.mean);
    json[name + "_rms_absolute"] = number(lengths.rms);
    json[name + "_max_absolute"] = number(lengths.max);
}

void add_displacement(Json& json, const DisplacementStatistics& displacement, double mean_edge)
{
    add_relative(json, "tangential", displacement.tangential, mean_edge);
    add_relative(json, "normal", displacement.normal, mean_edge);
}

Json total_json(const TotalDisplacement& total, double mean_edge)
{
    Json json;
    add_displacement(json, total.path, mean_edge);
    add_relative(json, "drift", total.drift, mean_edge);
    return json;
}

Json seconds_json(const RunRecord& run, const PhaseSeconds& seconds)
{
    return {{"read", number(run.read_seconds)},       {"cut", number(seconds.cut)},
            {"analyse", number(seconds.analyse)},     {"assemble", number(seconds.assemble)},
            {"factorise", number(seconds.factorise)}, {"solve", number(seconds.solve)},
            {"correct", number(seconds.correct)},     {"interface", number(seconds.interface)},
            {"step", number(seconds.step)},           {"total", number(seconds.total)},
            {"write", number(run.write_seconds)}};
}

Json steps_json(const std::vector<StepReport>& steps, double mean_edge)
{
    Json list = Json::array();
    for (const StepReport& step : steps) {
        Json json{{"seconds", number(step.seconds)},
                  {"max_mean_curvature_before", number(step.max_mean_curvature_before)},
                  {"max_mean_curvature_after", number(step.max_mean_curvature_after)}};
        add_displacement(json, step.displacement, mean_edge);
        if (step.iterations)
            json["iterations"] = *step.iterations;
        if (step.residual)
            json["residual"] = number(*step.residual);
        if (step.gap)
            add_statistics(json, "gap", *step.gap, mean_edge);
        if (step.estimated_v_max)
            json["estimated_v_max"] = number(*step.estimated_v_max);
        if (step.distance)
            add_distance(json, *step.distance);
        if (step.reference_seconds)
            json["reference_seconds"] = number(*step.reference_seconds);
        list.push_back(std::move(json));
    }
    return list;
}

/// Names of files need not be valid UTF-8, JSON must.
std::string text_of(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string smooth_report_json(const RunRecord& run, const FlowReport& report)
{
    Json json;
    json["input"] = run.input;
    json["output"] = run.output;
    json["arguments"] = run.arguments;
    json["vertices"] = report.vertices;
    json["faces"] = report.faces;
    json["mean_edge"] = number(run.scale.mean_edge);
    json["diagonal"] = number(run.scale.diagonal);
    json["subdomains"] = report.subdomains;
    json["subdomain_vertices"] = report.subdomain_vertices;
    json["subdomain_faces"] = report.subdomain_faces;
    json["subdomain_colors"] = report.subdomain_colors;
    json["colors"] = report.colors;
    json["interface_vertices"] = report.interface_vertices;
    json["repaired_faces"] = report.repaired_faces;
    json["non_manifold_vertices"] = report.non_manifold_vertices;
    json["fixed_vertices"] = report.fixed_vertices;
    json["laplacian"] = run.laplacian;
    json["time_step"] = number(report.time_step);
    json["time_step_edges"] = number(report.time_step / (run.scale.mean_edge * run.scale.mean_edge));
    json["radius"] =
        number(smoothed_radius(report.time_step, static_cast<int>(std::max<std::size_t>(report.steps.size(), 1))));
    if (report.tolerance) {
        json["tolerance"] = number(*report.tolerance);
        json["steps_short_of_tolerance"] = report.steps_short_of_tolerance;
        json["steps_stagnated"] = report.steps_stagnated;
    }
    json["threads"] = report.threads;
    json["p"] = numbers(report.p);
    json["live_factors"] = report.live_factors;
    json["factor_memory_bytes"] = report.factor_memory_bytes;
    json["seconds"] = seconds_json(run, report.seconds);
    json["steps"] = steps_json(report.steps, run.scale.mean_edge);
    json["displacement"] = total_json(report.displacement, run.scale.mean_edge);
    json["remarks"] = report.remarks;
    json["peak_memory_bytes"] = peak_memory_bytes();
    return text_of(json);
}

std::string compare_report_json(const Comparison& comparison)
{
    Json json;
    json["reference"] = comparison.reference;
    json["candidate"] = comparison.candidate;
    json["vertices"] = comparison.vertices;
    json["faces"] = comparison.faces;
    json["mean_edge"] = number(comparison.mean_edge);
    if (comparison.vertex_distance)
        add_distance(json, *comparison.vertex_distance);
    json["direction"] = name_of(comparison.direction);
    if (comparison.surface_distance)
        add_statistics(json, "h", *comparison.surface_distance, comparison.mean_edge);
    if (comparison.surface_distance_back)
        add_statistics(json, "h_back", *comparison.surface_distance_back, comparison.mean_edge);
    if (comparison.displacement)
        add_displacement(json, *comparison.displacement, comparison.mean_edge);
    json["remarks"] = comparison.remarks;
    return text_of(json);
}

}  // namespace seamflow
