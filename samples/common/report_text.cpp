#include "samples/common/report_text.h"

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <string>

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
        << counted(mesh.n_faces(), "face", "faces") << ", mean edge " << digits(run.mean_edge) << std::endl;
}

void print_step(std::ostream& out, const StepReport& report, int step, int steps)
{
    out << "step " << step << " of " << steps << "  " << seconds(report.seconds) << "  largest mean curvature "
        << digits(report.max_mean_curvature_before) << " -> " << digits(report.max_mean_curvature_after);
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
    print_times(out, run, report.seconds);
    out << "threads    " << report.threads << '\n';
    out << "memory     " << digits(static_cast<double>(peak_memory_bytes()) / 1e6, 4) << " MB at most\n";
    for (const std::string& remark : report.remarks)
        out << "remark     " << remark << '\n';
    out << "result     " << run.output << std::endl;
}

void print_comparison(std::ostream& out, const Comparison& comparison)
{
    const VertexDistance& distance = comparison.distance;
    print_distance(out, "V_mean", distance.mean, distance.mean_edge);
    print_distance(out, "V_RMS ", distance.rms, distance.mean_edge);
    print_distance(out, "V_max ", distance.max, distance.mean_edge);
    out << "(" << counted(comparison.vertices, "vertex", "vertices") << ", mean edge of " << comparison.reference
        << ": " << digits(distance.mean_edge, 10) << ")" << std::endl;
}

}  // namespace seamflow
