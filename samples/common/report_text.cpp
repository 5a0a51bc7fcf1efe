#include "samples/common/report_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>

#include "engine/setup/smoothing_amount.h"
#include "samples/common/peak_memory.h"

namespace seamflow {

namespace {

std::string digits(double value, int significant = 6)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", significant, value);
    return text;
}

std::string seconds(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.3f s", value);
    return text;
}

std::string counted(Index count, const std::string& singular, const std::string& plural)
{
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

void print_cut(std::ostream& out, const FlowReport& report)
{
    out << "cut        " << counted(report.subdomains, "sub-mesh", "sub-meshes") << " in "
        << counted(report.colors, "colour", "colours") << ", "
        << counted(report.interface_vertices, "interface vertex", "interface vertices") << '\n';
    std::vector<Index> sizes = report.subdomain_vertices;
    if (sizes.empty())
        return;
    std::sort(sizes.begin(), sizes.end());
    out << "sizes      " << sizes.front() << " / " << sizes[sizes.size() / 2] << " / " << sizes.back()
        << " vertices (smallest / median / largest)\n";
}

void print_times(std::ostream& out, const RunRecord& run, const PhaseSeconds& phases)
{
    out << "time       read " << seconds(run.read_seconds) << ", cut " << seconds(phases.cut) << ", analyse "
        << seconds(phases.analyse) << ", all steps " << seconds(phases.step) << ", write " << seconds(run.write_seconds)
        << '\n';
    out << "in tasks   assemble " << seconds(phases.assemble) << ", factorise " << seconds(phases.factorise)
        << ", solve " << seconds(phases.solve) << ", correct " << seconds(phases.correct) << " (summed over threads)\n";
}

/// Explicit Euler steps factorise nothing. Only Cholesky's method has its memory set aside.
void print_factors(std::ostream& out, const FlowReport& report)
{
    if (report.live_factors == 0)
        return;
    out << "factors    at most " << report.live_factors << " at once";
    if (report.factor_memory_bytes > 0)
        out << ", " << digits(static_cast<double>(report.factor_memory_bytes) / 1e6, 4) << " MB";
    out << '\n';
}

/// One line: mean, RMS and largest in units of `unit`.
void print_lengths(std::ostream& out, const char* name, const LengthStatistics& lengths, double unit)
{
    const bool relative = unit > 0.0;
    const double divisor = relative ? unit : 1.0;
    out << name << "mean " << digits(lengths.mean / divisor) << ", RMS " << digits(lengths.rms / divisor)
        << ", largest " << digits(lengths.max / divisor) << (relative ? " mean edge lengths" : "") << '\n';
}

void print_total(std::ostream& out, const TotalDisplacement& total, double mean_edge)
{
    const double unit = mean_edge > 0.0 ? mean_edge : 1.0;
    out << "moved      tangentially " << digits(total.path.tangential.mean / unit, 4) << " (largest "
        << digits(total.path.tangential.max / unit, 4) << ", net " << digits(total.drift.mean / unit, 4)
        << "), normally " << digits(total.path.normal.mean / unit, 4) << " (largest "
        << digits(total.path.normal.max / unit, 4) << ") mean edge lengths on average\n";
}

void print_distance(std::ostream& out, const char* name, double absolute, double mean_edge)
{
    out << name << "  " << digits(absolute, 10);
    if (mean_edge > 0.0)
        out << "  =  " << digits(absolute / mean_edge) << " mean edge lengths";
    out << '\n';
}

}  // namespace

void print_input(std::ostream& out, const RunRecord& run, const PolygonMesh& mesh)
{
    out << "input      " << run.input << ": " << counted(mesh.n_vertices(), "vertex", "vertices") << ", "
        << counted(mesh.n_faces(), "face", "faces") << ", mean edge " << digits(run.scale.mean_edge) << std::endl;
}

void print_amount(std::ostream& out, const MeshScale& scale, const FlowOptions& options)
{
    const int steps = std::max(options.steps, 1);
    const double radius = options.steps == 0 ? 0.0 : smoothed_radius(options.time_step, steps);
    out << "amount     dt " << digits(options.time_step) << " = "
        << digits(options.time_step / (scale.mean_edge * scale.mean_edge)) << " squared mean edge lengths, √dt "
        << digits(std::sqrt(options.time_step)) << "; "
        << (options.steps == 1 ? "one step smooths" : std::to_string(options.steps) + " steps smooth")
        << " bumps of radius " << digits(radius) << " = " << digits(100.0 * radius / scale.diagonal, 3)
        << "% of the diagonal" << std::endl;
}

void print_step(std::ostream& out, const StepReport& report, int step, int steps, double mean_edge)
{
    out << "step " << step << " of " << steps << "  " << seconds(report.seconds) << "  largest mean curvature "
        << digits(report.max_mean_curvature_before) << " -> " << digits(report.max_mean_curvature_after);
    if (report.iterations)
        out << "  iterations " << *report.iterations << ", residual " << digits(report.residual.value_or(0.0), 2);
    if (report.gap) {
        const double unit = mean_edge > 0.0 ? mean_edge : 1.0;
        out << "  gap mean " << digits(report.gap->mean / unit) << ", largest " << digits(report.gap->max / unit);
    }
    if (report.estimated_v_max)
        out << "  estimated distance to the undecomposed flow " << digits(*report.estimated_v_max, 2)
            << " mean edge lengths";
    if (report.distance) {
        const VertexDistance& distance = *report.distance;
        const double unit = distance.mean_edge > 0.0 ? distance.mean_edge : 1.0;
        out << "  V_mean " << digits(distance.mean / unit) << "  V_RMS " << digits(distance.rms / unit) << "  V_max "
            << digits(distance.max / unit);
    }
    if (report.reference_seconds)
        out << "  (undecomposed " << seconds(*report.reference_seconds) << ")";
    out << std::endl;
}

void print_summary(std::ostream& out, const RunRecord& run, const FlowReport& report)
{
    out << "flow       " << run.laplacian << ", time step " << digits(report.time_step, 10) << '\n';
    print_cut(out, report);
    print_factors(out, report);
    print_times(out, run, report.seconds);
    print_total(out, report.displacement, run.scale.mean_edge);
    out << "threads    " << report.threads << '\n';
    out << "memory     " << digits(static_cast<double>(peak_memory_bytes()) / 1e6, 4) << " MB at most\n";
    for (const std::string& remark : report.remarks)
        out << "remark     " << remark << '\n';
    out << "result     " << run.output << std::endl;
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
