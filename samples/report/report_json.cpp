#include "samples/report/report_json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include "partition/version.h"
#include "samples/report/mesh_scale.h"

namespace seamflow {

ReportJson begin_report(const RunRecord& run)
{
    return {{"schema", report_schema},
            {"version", version},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
            {"input", run.input},
            {"output", run.output},
            {"arguments", run.arguments}};
}

ReportJson json_number(double value)
{
    return std::isfinite(value) ? ReportJson(value) : ReportJson(nullptr);
}

void add_lengths(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double unit,
                 const char* ending)
{
    json[name + "_mean" + ending] = json_number(lengths.mean / unit);
    json[name + "_rms" + ending] = json_number(lengths.rms / unit);
    json[name + "_max" + ending] = json_number(lengths.max / unit);
}

void add_statistics(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double mean_edge)
{
    add_lengths(json, name, lengths, mean_edge);
    add_lengths(json, name, lengths, 1.0, "_absolute");
}

void add_convergence(ReportJson& json, const ConvergenceReport& convergence)
{
    if (!convergence.tolerance)
        return;
    json["tolerance"] = json_number(*convergence.tolerance);
    json["steps_short_of_tolerance"] = convergence.steps_short_of_tolerance;
    json["steps_stagnated"] = convergence.steps_stagnated;
}

void add_ranks(ReportJson& json, const std::vector<RankRecord>& ranks)
{
    for (const RankRecord& rank : ranks)
        json["ranks"].push_back({{"vertices", rank.vertices},
                                 {"foreign_vertices", rank.foreign_vertices},
                                 {"messages", rank.messages},
                                 {"bytes", rank.bytes},
                                 {"threads", rank.threads},
                                 {"peak_memory_bytes", rank.peak_memory_bytes}});
}

ReportJson look_json(const SurfaceLook& look)
{
    ReportJson json{
        {"area", json_number(look.area)},
        {"volume", look.volume ? json_number(*look.volume) : ReportJson(nullptr)},
        {"roughness_rms", look.roughness ? json_number(look.roughness->rms) : ReportJson(nullptr)},
        {"roughness_percentile_95", look.roughness ? json_number(look.roughness->percentile_95) : ReportJson(nullptr)}};
    if (!look.cell_volumes.empty()) {
        ReportJson& list = json["cell_volumes"] = ReportJson::array();
        for (const double volume : look.cell_volumes)
            list.push_back(json_number(volume));
    }
    if (look.self_intersections)
        json["self_intersections"] = *look.self_intersections;
    return json;
}

ReportJson remarks_json(const std::vector<RemarkInWords>& remarks)
{
    ReportJson json = ReportJson::array();
    for (const RemarkInWords& remark : remarks) {
        ReportJson numbers = ReportJson::object();
        for (const auto& [name, value] : remark.numbers)
            numbers[name] = json_number(value);
        json.push_back({{"kind", remark.kind}, {"numbers", numbers}, {"text", remark.text}});
    }
    return json;
}

std::string text_of(const ReportJson& json)
{
    return json.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

namespace {

using Json = ReportJson;

/// x, y and z.
Json coordinates_json(const Point& coordinates)
{
    return {json_number(coordinates.x()), json_number(coordinates.y()), json_number(coordinates.z())};
}

/// One member of every sub-mesh.
template <class Value>
Json of_sub_meshes(const CutReport& cut, Value SubMeshReport::*member)
{
    Json list = Json::array();
    for (const SubMeshReport& sub_mesh : cut.sub_meshes) {
        if constexpr (std::is_same_v<Value, double>)
            list.push_back(json_number(sub_mesh.*member));
        else
            list.push_back(sub_mesh.*member);
    }
    return list;
}

void add_distance(Json& json, const VertexDistance& distance)
{
    add_statistics(json, "v", {distance.mean, distance.rms, distance.max}, distance.mean_edge);
    json["mean_edge"] = json_number(distance.mean_edge);
}

void add_displacement(Json& json, const DisplacementStatistics& displacement, double mean_edge)
{
    add_lengths(json, "tangential", displacement.tangential, mean_edge);
    add_lengths(json, "normal", displacement.normal, mean_edge);
}

Json total_json(const TotalDisplacement& total, double mean_edge)
{
    Json json;
    add_displacement(json, total.path, mean_edge);
    add_lengths(json, "drift", total.drift, mean_edge);
    return json;
}

Json seconds_json(const RunRecord& run, const PhaseSeconds& seconds)
{
    return {{"read", json_number(run.read_seconds)},
            {"choose", json_number(run.choose_seconds)},
            {"cut", json_number(seconds.cut)},
            {"analyse", json_number(seconds.analyse)},
            {"assemble", json_number(seconds.assemble)},
            {"factorise", json_number(seconds.factorise)},
            {"solve", json_number(seconds.solve)},
            {"correct", json_number(seconds.correct)},
            {"interface", json_number(seconds.interface)},
            {"step", json_number(seconds.step)},
            {"total", json_number(seconds.total)},
            {"write", json_number(run.write_seconds)}};
}

Json steps_json(const std::vector<StepReport>& steps, double mean_edge)
{
    Json list = Json::array();
    for (const StepReport& step : steps) {
        Json json{{"seconds", json_number(step.seconds)}};
        json["max_mean_curvature_before"] = json_number(step.max_mean_curvature_before);
        json["max_mean_curvature_after"] = json_number(step.max_mean_curvature_after);
        add_displacement(json, step.displacement, mean_edge);
        if (step.iterations)
            json["iterations"] = *step.iterations;
        if (step.residual)
            json["residual"] = json_number(*step.residual);
        if (step.gap)
            add_statistics(json, "gap", *step.gap, mean_edge);
        if (step.estimated_v_max)
            json["estimated_v_max"] = json_number(*step.estimated_v_max);
        if (step.distance)
            add_distance(json, *step.distance);
        if (step.distance && step.surface_distance)
            add_statistics(json, "h", *step.surface_distance, step.distance->mean_edge);
        if (step.reference_seconds)
            json["reference_seconds"] = json_number(*step.reference_seconds);
        list.push_back(std::move(json));
    }
    return list;
}

Json surface_json(const RunRecord& run)
{
    Json json{{"before", look_json(run.surface.before)}, {"after", look_json(run.surface.after)}};
    add_statistics(json, "moved", run.surface.moved, run.scale.mean_edge);
    if (run.surface.flipped_faces)
        json["flipped_faces"] = *run.surface.flipped_faces;
    if (run.surface.folded_faces)
        json["folded_faces"] = *run.surface.folded_faces;
    if (run.surface.new_self_intersections)
        json["new_self_intersections"] = *run.surface.new_self_intersections;
    return json;
}

/// How often this process has touched a page of memory, small or large, that the system had to provide first.
std::int64_t page_faults()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::int64_t{usage.ru_minflt} + usage.ru_majflt;
}

/// Empty if missing or not a number.
std::string text_of_cell(const Json& value)
{
    return value.is_null() ? "" : value.dump();
}

/// The flow and its amount.
void add_flow(Json& json, const RunRecord& run, const AllOptions& options, const SmoothReport& report)
{
    const MotionOptions& motion = options.motion;
    const FlowNames& names = run.names;
    json["laplacian"] = names.laplacian;
    json["flow"] = names.flow;
    json["filter"] = names.filter;
    json["order"] = names.order;
    if (!run.preset.empty())
        json["preset"] = run.preset;
    if (run.noise)
        json["noise"] = json_number(*run.noise);
    if (report.noise) {
        json["noise"] = json_number(report.noise->deviation);
        json["noisy_part"] = json_number(report.noise->part);
    }
    if (report.rounding) {
        json["rounded"] = coordinates_json(report.rounding->steps);
        json["fairing_iterations"] = report.rounding->iterations;
        json["fairing_last_motion"] = json_number(report.rounding->last_motion);
    }
    if (motion.attachment > 0.0)
        json["attachment"] = json_number(motion.attachment);
    json["attachment_weights"] = !motion.attachment_weights.empty();
    json["rescale"] = names.rescale;
    if (options.keep_edges)
        json["keep_edges"] = json_number(*options.keep_edges);
    if (names.radius) {
        json["time_step"] = json_number(report.time_step);
        json["time_step_edges"] = json_number(report.time_step / (run.scale.mean_edge * run.scale.mean_edge));
        json["radius"] = json_number(*names.radius);
    }
    // Where normals are smoothed there is no equation.
    if (!options.keep_edges && names.radius)
        json["approach"] = names.approach;
}

}  // namespace

std::string smooth_report_json(const RunRecord& run, const AllOptions& options, const SmoothReport& report)
{
    Json json = begin_report(run);
    json["vertices"] = report.mesh.vertices;
    json["faces"] = report.mesh.faces;
    json["mean_edge"] = json_number(run.scale.mean_edge);
    json["diagonal"] = json_number(run.scale.diagonal);
    json["subdomains"] = report.cut.n_sub_meshes();
    json["subdomain_vertices"] = of_sub_meshes(report.cut, &SubMeshReport::vertices);
    json["subdomain_faces"] = of_sub_meshes(report.cut, &SubMeshReport::faces);
    json["subdomain_colours"] = of_sub_meshes(report.cut, &SubMeshReport::colour);
    json["colours"] = report.cut.n_colours();
    json["interface_vertices"] = report.cut.interface_vertices;
    json["repaired_faces"] = report.cut.repaired_faces;
    json["non_manifold_vertices"] = report.mesh.non_manifold_vertices;
    json["junction_vertices"] = report.mesh.junction_vertices;
    if (!options.motion.strength.empty())
        json["region"] = true;
    json["fixed_vertices"] = report.mesh.fixed_vertices;
    add_flow(json, run, options, report);
    add_convergence(json, report.convergence);
    json["threads"] = report.resources.threads;
    json["p"] = of_sub_meshes(report.cut, &SubMeshReport::p);
    json["live_factors"] = report.resources.live_factors;
    json["factor_memory_bytes"] = report.resources.factor_memory_bytes;
    json["single_factors"] = report.resources.single_factors;
    json["seconds"] = seconds_json(run, report.seconds);
    json["steps"] = steps_json(report.steps, run.scale.mean_edge);
    if (report.displacement)
        json["displacement"] = total_json(*report.displacement, run.scale.mean_edge);
    json["surface"] = surface_json(run);
    json["choices"] = remarks_json(run.choices_in_words);
    json["remarks"] = remarks_json(run.remarks_in_words);
    json["peak_memory_bytes"] = peak_memory_of(run);
    json["page_faults"] = page_faults();
    add_ranks(json, run.ranks);
    return text_of(json);
}

std::string smooth_failure_json(const RunRecord& run, const Failure& failure)
{
    Json json = begin_report(run);
    json["error"] = {{"message", failure.message}, {"exit_status", static_cast<int>(failure.status)}};
    return text_of(json);
}

std::string steps_csv(std::string_view report)
{
    const Json json = Json::parse(report);
    std::vector<std::string> columns;
    for (const Json& step : json.at("steps"))
        for (const auto& [key, value] : step.items())
            if (std::ranges::find(columns, key) == columns.end())
                columns.push_back(key);
    std::vector<double> p;
    for (const Json& of_sub_mesh : json.value("p", Json::array()))
        if (of_sub_mesh.is_number())
            p.push_back(of_sub_mesh.get<double>());
    std::string of_p = ",";
    if (!p.empty())
        of_p = Json(std::ranges::min(p)).dump() + "," + Json(std::ranges::max(p)).dump();
    std::string text =
        fmt::format("step,p_smallest,p_largest{}{}\n", columns.empty() ? "" : ",", fmt::join(columns, ","));
    for (std::size_t i = 0; i < json.at("steps").size(); ++i) {
        text += fmt::format("{},{}", i + 1, of_p);
        for (const std::string& column : columns)
            text += fmt::format(",{}", text_of_cell(json.at("steps")[i].value(column, Json(nullptr))));
        text += "\n";
    }
    return text;
}

std::string compare_report_json(const Comparison& comparison)
{
    Json json;
    json["reference"] = comparison.reference;
    json["candidate"] = comparison.candidate;
    json["vertices"] = comparison.vertices;
    json["faces"] = comparison.faces;
    json["mean_edge"] = json_number(comparison.mean_edge);
    if (comparison.vertex_distance)
        add_distance(json, *comparison.vertex_distance);
    json["direction"] = name_of(comparison.direction);
    if (comparison.surface_distance)
        add_statistics(json, "h", *comparison.surface_distance, comparison.mean_edge);
    if (comparison.surface_distance_back)
        add_statistics(json, "h_back", *comparison.surface_distance_back, comparison.mean_edge);
    if (comparison.displacement)
        add_displacement(json, *comparison.displacement, comparison.mean_edge);
    if (comparison.flipped_faces)
        json["flipped_faces"] = *comparison.flipped_faces;
    json["self_intersections"] = comparison.self_intersections;
    json["candidate_self_intersections"] = comparison.candidate_self_intersections;
    json["remarks"] = comparison.remarks;
    return text_of(json);
}

std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found,
                            const SurfaceRoughness& roughness)
{
    const auto& sides = found.counts.faces_by_sides;
    const MeshDefects& defects = found.defects;
    Json json{
        {"file", file},
        {"vertices", found.counts.vertices},
        {"edges", found.counts.edges},
        {"faces", found.counts.faces},
        {"faces_by_sides", {{"3", sides[0]}, {"4", sides[1]}, {"5", sides[2]}, {"6", sides[3]}, {"more", sides[4]}}},
        {"components", found.counts.components},
        {"boundary_edges", found.counts.boundary_edges},
        {"seam_edges", found.counts.seam_edges},
        {"seam_vertices", found.counts.seam_vertices},
        {"shortest_edge", found.edge_lengths.shortest},
        {"mean_edge", found.edge_lengths.mean},
        {"longest_edge", found.edge_lengths.longest},
        {"middle", found.box.middle},
        {"diagonal", found.box.diagonal},
        {"bits_for_detail", found.bits_for_detail},
        {"orientable", found.orientable},
        {"faults", faults.count},
        {"fault_messages", faults.messages},
        {"vertices_not_finite", defects.vertices_not_finite},
        {"non_manifold_edges", defects.non_manifold_edges},
        {"non_manifold_vertices", defects.non_manifold_vertices},
        {"inconsistent_edges", defects.inconsistent_edges},
        {"duplicate_faces", defects.duplicate_faces},
        {"faces_without_area", defects.faces_without_area},
        {"edges_without_length", defects.edges_without_length},
        {"coincident_vertices", defects.coincident_vertices},
        {"isolated_vertices", defects.isolated_vertices},
        {"far_vertices", defects.far_vertices},
        {"spikes", defects.spikes},
        {"faces_turned_round", defects.n_turned_round},
        {"crack_vertices", found.cracks ? found.cracks->n_vertices : 0},
        {"crack_width", found.cracks ? found.cracks->width : 0.0},
        {"weld_distance", found.cracks ? found.cracks->weld_distance : 0.0},
        {"self_intersections", defects.self_intersections},
    };
    if (const std::optional<SurfaceNoise>& noise = roughness.noise) {
        json["noise"] = json_number(noise->edge > 0.0 ? noise->deviation / noise->edge : 0.0);
        json["noisy_part"] = json_number(noise->part);
    }
    if (roughness.steps)
        json["rounded"] = coordinates_json(*roughness.steps);
    return text_of(json);
}

}  // namespace seamflow
