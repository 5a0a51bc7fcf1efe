#include "samples/benchmark/case_text.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace seamflow {

namespace {

std::string seconds(double value)
{
    return short_number(value);
}

void print_cells(std::ostream& out, const std::string& name, std::initializer_list<std::string> cells)
{
    char text[128];
    std::snprintf(text, sizeof text, "%-34s", name.c_str());
    out << text;
    for (const std::string& cell : cells) {
        std::snprintf(text, sizeof text, " %9s", cell.c_str());
        out << text;
    }
    out << std::endl;
}

std::string named(const Row& row)
{
    const bool equal = row.name.ends_with("-equal-accuracy") || row.name.ends_with("-equal-both");
    return equal && row.succeeded() ? row.name + " " + short_number(row.task.tolerance, 1) : row.name;
}

/// Empty if phases are unknown.
std::string phase(double value)
{
    return value > 0.0 ? seconds(value) : "";
}

}  // namespace

std::string short_number(double value, int significant)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", significant, value);
    return text;
}

CaseTable::CaseTable(std::ostream& out, const std::string& mesh, Index vertices, double dt_over_h2,
                     const CaseOptions& options)
    : out_(out)
{
    const FlowOptions& flow = options.flow;
    out_ << mesh << ", " << vertices << " vertices, " << name_of(flow.laplacian) << ", dt " << short_number(dt_over_h2)
         << " squared mean edge lengths, " << flow.steps << (flow.steps == 1 ? " step, " : " steps, ")
         << flow.resources.threads << (flow.resources.threads == 1 ? " thread\n" : " threads\n");
    print_cells(out_, "seconds",
                {"setup", "assemble", "prepare", "solve", "step", "all", "MB", "iter.", "V_mean", "V_max", "ratio",
                 "1 thread"});
}

void CaseTable::print(const Row& row)
{
    if (!row.succeeded()) {
        print_cells(out_, row.name, {row.result.error});
        return;
    }
    const double step = row.result.step_seconds();
    if (row.name == "ours")
        ours_ = ours_one_thread_ = step;
    if (row.name == "ours-one-thread")
        ours_one_thread_ = step;
    const StepSeconds& phases = row.result.phases;
    const bool one_thread = row.task.method == Method::Amg;
    print_cells(out_, named(row),
                {seconds(row.result.setup_seconds), phase(phases.assemble), phase(phases.prepare), phase(phases.solve),
                 seconds(step), seconds(row.result.total_seconds()),
                 short_number(static_cast<double>(row.result.peak_memory_bytes) / 1e6, 4),
                 row.result.iterations > 0 ? std::to_string(row.result.iterations) : "",
                 row.v_mean ? short_number(*row.v_mean, 2) : "", row.v_max ? short_number(*row.v_max, 2) : "",
                 short_number(step / ours_), one_thread ? short_number(step / ours_one_thread_) : ""});
}

void CaseTable::finish(const CaseResult& result) const
{
    out_ << "ours: " << result.ours.result.subdomains << " sub-meshes, phases summed over threads; step: median after "
         << "the first; all: setup and all steps; ratio: step in steps of ours\n";
    if (!result.reference.empty())
        out_ << "V_mean, V_max: distance to the undecomposed flow by " << result.reference
             << " after the last step, in mean edge lengths\n";
    const auto is_iterative_row = [](const Row& row) { return is_iterative(row.task.method) && row.succeeded(); };
    if (std::any_of(result.peers.begin(), result.peers.end(), is_iterative_row)) {
        out_ << "iter.: of all steps; of amg, cg-ic and bicgstab of all coordinates, too";
        if (!result.reference.empty())
            out_ << "; equal accuracy: the loosest tolerance with a V_max no larger than ours, equal both: V_mean too";
        out_ << '\n';
    }
    for (const std::string& remark : result.ours.result.remarks)
        out_ << "remark: " << remark << '\n';
    for (const Row& peer : result.peers)
        if (peer.task.method == Method::Amg && peer.succeeded()) {
            out_ << "amg takes one thread; under \"1 thread\", in steps of ours with one\n";
            break;
        }
    for (const Row& peer : result.peers)
        if (peer.task.method == Method::SmoothShape && peer.succeeded())
            out_ << "cgal: smooth_shape takes the step of alexa-wardetzky whatever the Laplacian, builds its system "
                    "anew in each step, and solves to rounding\n";
    out_ << std::endl;
}

}  // namespace seamflow
