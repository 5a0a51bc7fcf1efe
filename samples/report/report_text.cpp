#include "samples/report/report_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partition/text.h"
#include "samples/report/mesh_scale.h"

namespace seamflow {

namespace {

std::string digits(double value, int significant = 6)
{
    return fmt::format("{:.{}g}", value, significant);
}

void print_cut(std::ostream& out, const FlowReport& report)
{
    if (takes_whole_mesh(report.convergence.approach)) {
        out << fmt::format("cut        none: {} of the whole mesh\n",
                           report.convergence.approach == Approach::Undecomposed ? "one factorisation"
                                                                                 : "conjugate gradients");
        return;
    }
    out << fmt::format("cut        {} in {}, {}\n", counted(report.cut.n_sub_meshes(), "sub-mesh", "sub-meshes"),
                       counted(report.cut.n_colours(), "colour", "colours"),
                       counted(report.cut.interface_vertices, "interface vertex", "interface vertices"));
    std::vector<Index> sizes;
    for (const SubMeshReport& sub_mesh : report.cut.sub_meshes)
        sizes.push_back(sub_mesh.vertices);
    if (sizes.empty())
        return;
    std::sort(sizes.begin(), sizes.end());
    out << fmt::format("sizes      {} / {} / {} vertices (smallest / median / largest)\n", sizes.front(),
                       sizes[sizes.size() / 2], sizes.back());
}

/// "a -> b".
std::string change(double before, double after, int significant)
{
    return digits(before, significant) + " -> " + digits(after, significant);
}

/// Explicit Euler steps factorise nothing. Memory is set aside only for Cholesky's method.
void print_factors(std::ostream& out, const FlowReport& report)
{
    if (report.resources.live_factors == 0)
        return;
    out << "factors    at most " << report.resources.live_factors << " at once";
    if (report.resources.factor_memory_bytes > 0)
        out << ", " << digits(static_cast<double>(report.resources.factor_memory_bytes) / 1e6, 4) << " MB";
    if (report.resources.single_factors > 0)
        out << ", " << report.resources.single_factors << " in single precision";
    out << '\n';
}

/// One line: mean, RMS and largest in units of `unit`.
void print_lengths(std::ostream& out, const char* name, const LengthStatistics& lengths, double unit)
{
    const bool relative = unit > 0.0;
    const double divisor = relative ? unit : 1.0;
    out << fmt::format("{}mean {:.6g}, RMS {:.6g}, largest {:.6g}{}\n", name, lengths.mean / divisor,
                       lengths.rms / divisor, lengths.max / divisor, relative ? " mean edge lengths" : "");
}

void print_total(std::ostream& out, const TotalDisplacement& total, double mean_edge)
{
    const double unit = mean_edge > 0.0 ? mean_edge : 1.0;
    out << fmt::format("moved      tangentially {:.4g} (largest {:.4g}, net {:.4g}), normally {:.4g} (largest {:.4g}) "
                       "mean edge lengths on average\n",
                       total.path.tangential.mean / unit, total.path.tangential.max / unit, total.drift.mean / unit,
                       total.path.normal.mean / unit, total.path.normal.max / unit);
}

void print_distance_to_reference(std::ostream& out, const StepReport& step)
{
    const double unit = step.distance->mean_edge > 0.0 ? step.distance->mean_edge : 1.0;
    const auto print = [&](const char* name, const auto& distance) {
        out << fmt::format("{0}_mean {1:.6g}  {0}_RMS {2:.6g}  {0}_max {3:.6g}", name, distance.mean / unit,
                           distance.rms / unit, distance.max / unit);
    };
    print("V", *step.distance);
    if (step.surface_distance) {
        out << "  ";
        print("H", *step.surface_distance);
    }
}

void print_distance(std::ostream& out, const char* name, double absolute, double mean_edge)
{
    out << fmt::format("{}  {:.10g}", name, absolute);
    if (mean_edge > 0.0)
        out << fmt::format("  =  {:.6g} mean edge lengths", absolute / mean_edge);
    out << '\n';
}

/// Of the largest cell, and of that with the largest change in proportion.
void print_cells(std::ostream& out, const std::vector<double>& before, const std::vector<double>& after)
{
    if (before.empty() || before.size() != after.size())
        return;
    std::size_t most = 0;
    for (std::size_t c = 1; c < before.size(); ++c)
        if (std::abs(after[c] / before[c] - 1.0) > std::abs(after[most] / before[most] - 1.0))
            most = c;
    out << "cells      " << counted(static_cast<std::uint64_t>(before.size()), "cell", "cells") << ": volume "
        << change(before[0], after[0], 6) << " of the largest; " << change(before[most], after[most], 6)
        << " of the one that changes most in proportion\n";
}

}  // namespace

void print_input(std::ostream& out, const RunRecord& run, std::int64_t n_vertices, std::int64_t n_faces)
{
    out << fmt::format("input      {}: {}, {}, mean edge {:.6g}", run.input, counted(n_vertices, "vertex", "vertices"),
                       counted(n_faces, "face", "faces"), run.scale.mean_edge)
        << std::endl;
}

void print_start(std::ostream& out, const RunRecord& run, std::int64_t n_vertices, std::int64_t n_faces,
                 const AllOptions& options)
{
    print_input(out, run, n_vertices, n_faces);
    if (!run.preset.empty()) {
        out << "preset     " << run.preset;
        if (run.noise)
            out << fmt::format(", for noise of {:.3g} mean edge lengths ({:.3g})", *run.noise,
                               *run.noise * run.scale.mean_edge);
        out << ": " << run.chosen << std::endl;
    }
    out << "amount     ";
    if (options.steps == 0 || options.denoise) {
        out << (options.steps == 0 ? "none" : "as much as there is noise at each place") << std::endl;
        return;
    }
    const MeshScale& scale = run.scale;
    out << fmt::format("{} of {:.6g} squared mean edge lengths (dt {:.6g})", counted(options.steps, "step", "steps"),
                       options.time_step / (scale.mean_edge * scale.mean_edge), options.time_step);
    if (options.keep_edges)
        out << fmt::format(", edges sharper than {:g} degrees kept", *options.keep_edges);
    else if (run.names.radius)
        out << fmt::format(": bumps of radius {:.6g}, {:.3g}% of the diagonal, lose half their height",
                           *run.names.radius, 100.0 * *run.names.radius / scale.diagonal);
    out << std::endl;
}

void print_step(std::ostream& out, const StepReport& report, int step, int steps, double mean_edge)
{
    const double edge = mean_edge > 0.0 ? mean_edge : 1.0;
    out << fmt::format("step {} of {}  {:.3f} s  moved ", step, steps, report.seconds);
    out << fmt::format("{:.3g} normally, {:.3g} tangentially", report.displacement.normal.mean / edge,
                       report.displacement.tangential.mean / edge);
    if (report.iterations)
        out << fmt::format("  iterations {}, residual {:.2g}", *report.iterations, report.residual.value_or(0.0));
    if (report.gap)
        out << fmt::format("  gap mean {:.6g}, largest {:.6g}", report.gap->mean / edge, report.gap->max / edge);
    if (report.estimated_v_max)
        out << fmt::format("  estimated distance to the undecomposed flow {:.2g} mean edge lengths",
                           *report.estimated_v_max);
    if (report.distance) {
        out << "  ";
        print_distance_to_reference(out, report);
    }
    if (report.reference_seconds)
        out << fmt::format("  (undecomposed {:.3f} s)", *report.reference_seconds);
    out << std::endl;
}

void print_details(std::ostream& out, const RunRecord& run, const AllOptions& options, const SmoothReport& report)
{
    const FlowNames& names = run.names;
    out << "flow       "
        << (report.rounding      ? std::string("smoothest surface within half a step of rounding")
            : report.noise       ? std::string("noise removed")
            : options.keep_edges ? fmt::format("edges sharper than {:g} degrees kept", *options.keep_edges)
                                 : std::string(names.laplacian));
    if (options.flow != FlowEquation::MeanCurvature)
        out << ", " << names.flow;
    if (!names.is_plain)
        out << ", " << names.filter << " of order " << names.order;
    if (options.motion.attachment > 0.0)
        out << ", attached with " << digits(options.motion.attachment, 4) << " / length²";
    if (!options.motion.attachment_weights.empty())
        out << ", attached by weights";
    if (options.motion.rescale != Rescale::None)
        out << ", " << names.rescale << " kept";
    if (names.radius)
        out << ", time step " << digits(report.time_step, 10);
    out << '\n';
    print_cut(out, report);
    print_factors(out, report);
    out << fmt::format(
        "in tasks   assemble {:.3f} s, factorise {:.3f} s, solve {:.3f} s, correct {:.3f} s (summed over threads)\n",
        report.seconds.assemble, report.seconds.factorise, report.seconds.solve, report.seconds.correct);
    if (report.displacement)
        print_total(out, *report.displacement, run.scale.mean_edge);
}

void print_ranks(std::ostream& out, const RunRecord& run, int n_ranks)
{
    if (run.ranks.empty() && n_ranks > 1)
        out << "ranks      rank 0 of " << n_ranks << " has done all of it: others share no such steps\n";
    if (run.ranks.empty())
        return;
    const auto [least, most] = std::ranges::minmax(run.ranks, {}, &RankRecord::vertices);
    out << "ranks      " << run.ranks.size() << ": " << least.vertices;
    if (most.vertices != least.vertices)
        out << " to " << most.vertices;
    out << " vertices" << (run.ranks.size() > 1 ? " each" : "") << '\n';
}

std::string time_of(const RunRecord& run, const PhaseSeconds& phases)
{
    const double set_up = run.choose_seconds + phases.cut + phases.analyse;
    const double saved = run.checkpoint_seconds;
    const double rest = run.seconds - run.read_seconds - set_up - phases.step - saved - run.write_seconds;
    return fmt::format("time       {:.3g} s: read {:.3f}, set-up {:.3f}, steps {:.3f}, {}write {:.3f}, rest {:.3f}",
                       run.seconds, run.read_seconds, set_up, phases.step,
                       saved > 0.0 ? fmt::format("checkpoints {:.3f}, ", saved) : "", run.write_seconds,
                       std::max(rest, 0.0));
}

void print_choices(std::ostream& out, const std::vector<RemarkInWords>& choices)
{
    for (std::size_t i = 0; i < choices.size(); ++i)
        out << (i == 0 ? "chosen     " : " ") << choices[i].text << (i + 1 == choices.size() ? "\n" : "");
}

void print_remarks(std::ostream& out, const std::vector<RemarkInWords>& remarks)
{
    for (const RemarkInWords& remark : remarks)
        out << "remark     " << remark.text << '\n';
}

std::string moved_in_words(const LengthStatistics& moved, double mean_edge)
{
    const double edge = mean_edge > 0.0 ? mean_edge : 1.0;
    return fmt::format("moved {:.3g} ({:.3g} mean edge lengths) on average, {:.3g} ({:.3g}) at most", moved.mean,
                       moved.mean / edge, moved.max, moved.max / edge);
}

void print_result(std::ostream& out, const RunRecord& run, const SmoothReport& report)
{
    print_choices(out, run.choices_in_words);
    out << fmt::format(
        "{}; {}, {} MB{}\n", time_of(run, report.seconds), counted(report.resources.threads, "thread", "threads"),
        digits(static_cast<double>(peak_memory_of(run)) / 1e6, 4), run.ranks.size() > 1 ? " of a rank at most" : "");
    print_remarks(out, run.remarks_in_words);
    if (!report.steps.empty() && report.steps.back().distance) {
        out << "distance   ";
        print_distance_to_reference(out, report.steps.back());
        out << " mean edge lengths, from the undecomposed flow\n";
    }
    const SurfaceLook& before = run.surface.before;
    const SurfaceLook& after = run.surface.after;
    const LengthStatistics& moved = run.surface.moved;
    if (before.self_intersections && after.self_intersections)
        out << fmt::format("crossing   {} of faces -> {}\n",
                           counted(static_cast<std::uint64_t>(*before.self_intersections), "pair", "pairs"),
                           *after.self_intersections);
    print_cells(out, before.cell_volumes, after.cell_volumes);
    out << "result     " << run.output << ": " << moved_in_words(moved, run.scale.mean_edge) << "; ";
    if (before.roughness && after.roughness)
        out << "roughness " << change(before.roughness->rms, after.roughness->rms, 3) << " degrees, ";
    out << "area " << change(before.area, after.area, 6);
    if (before.volume && after.volume)
        out << ", volume " << change(*before.volume, *after.volume, 6);
    if (!report.steps.empty() && report.steps.back().estimated_v_max.value_or(0.0) > 0.0)
        out << fmt::format("; by estimate {:.2g} mean edge lengths at most from the undecomposed flow",
                           *report.steps.back().estimated_v_max);
    out << std::endl;
}

void print_comparison(std::ostream& out, const Comparison& comparison)
{
    const double unit = comparison.mean_edge;
    const auto print = [&](const char* name, const auto& distance) {
        const std::string prefix = name;
        print_distance(out, (prefix + "_mean").c_str(), distance.mean, unit);
        print_distance(out, (prefix + "_RMS ").c_str(), distance.rms, unit);
        print_distance(out, (prefix + "_max ").c_str(), distance.max, unit);
    };
    if (comparison.vertex_distance)
        print("V", *comparison.vertex_distance);
    if (comparison.surface_distance)
        print("H", *comparison.surface_distance);
    if (comparison.surface_distance_back) {
        out << "from the vertices of the candidate to the surface of the reference:\n";
        print("H", *comparison.surface_distance_back);
    }
    if (comparison.flipped_faces)
        out << "flipped     " << counted(*comparison.flipped_faces, "face", "faces") << " by more than 90 degrees\n";
    out << "crossing    " << counted(comparison.self_intersections, "pair", "pairs") << " of faces in the reference, "
        << comparison.candidate_self_intersections << " in the candidate\n";
    if (comparison.displacement) {
        print_lengths(out, "tangential  ", comparison.displacement->tangential, unit);
        print_lengths(out, "normal      ", comparison.displacement->normal, unit);
    }
    for (const std::string& remark : comparison.remarks)
        out << "remark  " << remark << '\n';
    out << "(" << counted(comparison.vertices, "vertex", "vertices") << ", mean edge of " << comparison.reference
        << ": " << digits(unit, 10) << "; H_ " << name_of(comparison.direction) << ")" << std::endl;
}

void print_error_map(std::ostream& out, const std::string& file, const ErrorRange& range)
{
    out << "error map  " << file << ", from " << digits(range.first) << " (blue) to " << digits(range.last) << " (red)"
        << std::endl;
}

}  // namespace seamflow
