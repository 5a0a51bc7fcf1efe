#include "samples/common/report_json.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "engine/options/option_names.h"
#include "samples/common/peak_memory.h"
#include "samples/common/smoothing_request.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// One member of every sub-mesh.
template <class Value>
Json of_sub_meshes(const CutReport& cut, Value SubMeshReport::*member)
{
    Json list = Json::array();
    for (const SubMeshReport& sub_mesh : cut.sub_meshes) {
        if constexpr (std::is_same_v<Value, double>)
            list.push_back(number(sub_mesh.*member));
        else
            list.push_back(sub_mesh.*member);
    }
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

Json look_json(const SurfaceLook& look)
{
    Json json{{"area", number(look.area)},
              {"volume", look.volume ? number(*look.volume) : Json(nullptr)},
              {"roughness_rms", number(look.roughness.rms)},
              {"roughness_percentile_95", number(look.roughness.percentile_95)}};
    if (look.self_intersections)
        json["self_intersections"] = *look.self_intersections;
    return json;
}

Json surface_json(const RunRecord& run)
{
    Json json{{"before", look_json(run.surface.before)}, {"after", look_json(run.surface.after)}};
    add_statistics(json, "moved", run.surface.moved, run.scale.mean_edge);
    json["flipped_faces"] = run.surface.flipped_faces;
    json["folded_faces"] = run.surface.folded_faces;
    if (run.surface.new_self_intersections)
        json["new_self_intersections"] = *run.surface.new_self_intersections;
    return json;
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
    json["vertices"] = report.mesh.vertices;
    json["faces"] = report.mesh.faces;
    json["mean_edge"] = number(run.scale.mean_edge);
    json["diagonal"] = number(run.scale.diagonal);
    json["subdomains"] = report.cut.n_sub_meshes();
    json["subdomain_vertices"] = of_sub_meshes(report.cut, &SubMeshReport::vertices);
    json["subdomain_faces"] = of_sub_meshes(report.cut, &SubMeshReport::faces);
    json["subdomain_colours"] = of_sub_meshes(report.cut, &SubMeshReport::colour);
    json["colours"] = report.cut.n_colours();
    json["interface_vertices"] = report.cut.interface_vertices;
    json["repaired_faces"] = report.cut.repaired_faces;
    json["non_manifold_vertices"] = report.mesh.non_manifold_vertices;
    json["fixed_vertices"] = report.mesh.fixed_vertices;
    json["laplacian"] = run.laplacian;
    json["flow"] = option_name(run.flow);
    json["filter"] = option_name(run.filter.kind);
    json["order"] = run.filter.order;
    if (!run.preset.empty())
        json["preset"] = run.preset;
    if (run.noise)
        json["noise"] = number(*run.noise);
    if (run.attachment)
        json["attachment"] = number(*run.attachment);
    json["attachment_weights"] = run.has_attachment_weights;
    json["rescale"] = option_name(run.rescale);
    if (run.keep_edges)
        json["keep_edges"] = number(*run.keep_edges);
    json["time_step"] = number(report.time_step);
    json["time_step_edges"] = number(report.time_step / (run.scale.mean_edge * run.scale.mean_edge));
    json["radius"] = number(
        smoothed_radius(report.time_step, static_cast<int>(std::max<std::size_t>(report.steps.size(), 1)), run.filter));
    if (!run.keep_edges)
        json["approach"] = option_name(report.convergence.approach);
    if (report.convergence.tolerance) {
        json["tolerance"] = number(*report.convergence.tolerance);
        json["steps_short_of_tolerance"] = report.convergence.steps_short_of_tolerance;
        json["steps_stagnated"] = report.convergence.steps_stagnated;
    }
    json["threads"] = report.resources.threads;
    json["p"] = of_sub_meshes(report.cut, &SubMeshReport::p);
    json["live_factors"] = report.resources.live_factors;
    json["factor_memory_bytes"] = report.resources.factor_memory_bytes;
    json["single_factors"] = report.resources.single_factors;
    json["seconds"] = seconds_json(run, report.seconds);
    json["steps"] = steps_json(report.steps, run.scale.mean_edge);
    json["displacement"] = total_json(report.displacement, run.scale.mean_edge);
    json["surface"] = surface_json(run);
    json["choices"] = report.choices;
    json["remarks"] = report.remarks;
    json["peak_memory_bytes"] = peak_memory_bytes();
    return text_of(json);
}

std::string smooth_failure_json(const RunRecord& run, const Failure& failure)
{
    return text_of({{"input", run.input},
                    {"output", run.output},
                    {"arguments", run.arguments},
                    {"error", {{"message", failure.message}, {"exit_status", static_cast<int>(failure.status)}}}});
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
    if (comparison.flipped_faces)
        json["flipped_faces"] = *comparison.flipped_faces;
    json["self_intersections"] = comparison.self_intersections;
    json["candidate_self_intersections"] = comparison.candidate_self_intersections;
    json["remarks"] = comparison.remarks;
    return text_of(json);
}

std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found)
{
    const auto& sides = found.counts.faces_by_sides;
    const MeshDefects& defects = found.defects;
    const Json json{
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
        {"self_intersections", defects.self_intersections},
    };
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seamflow
