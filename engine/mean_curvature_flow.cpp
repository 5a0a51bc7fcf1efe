#include "engine/mean_curvature_flow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include <oneapi/tbb/parallel_invoke.h>

#include "engine/choose_subdomains.h"
#include "engine/choose_tolerance.h"
#include "engine/converged_flow.h"
#include "engine/decomposed_flow.h"
#include "engine/displacement_meter.h"
#include "engine/explicit_flow.h"
#include "engine/krylov_flow.h"
#include "engine/parallel_loop.h"
#include "engine/stopwatch.h"
#include "engine/surface_curvature.h"
#include "engine/workers.h"
#include "partition/cut/cut.h"
#include "partition/errors.h"
#include "partition/topology.h"
#include "solvers/degenerate.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

Cut uncut(const PolygonMesh& mesh)
{
    Cut cut;
    cut.labels.assign(at(mesh.n_faces()), 0);
    cut.n_parts = mesh.n_faces() > 0 ? 1 : 0;
    return cut;
}

const SubdomainNeeds& needs_of(const FlowOptions& options)
{
    if (!options.tolerance)
        return needs_of_sweeps;
    return is_symmetric(options.laplacian) ? needs_of_converged_steps : needs_of_krylov_steps;
}

Cut make_cut(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options)
{
    if (options.scheme == Scheme::ExplicitEuler)
        return uncut(mesh);
    if (!options.labels.empty())
        return cut_by_labels(mesh, topology, options.labels, run_in_parallel);
    if (options.subdomains > 0)
        return cut_into(mesh, topology, options.subdomains, run_in_parallel);
    const SubdomainChoice choice = choose_subdomains(mesh, options.time_step, needs_of(options));
    Cut cut = cut_into(mesh, topology, choice.count, run_in_parallel);
    cut.remarks.insert(cut.remarks.begin(), choice.reason + ".");
    return cut;
}

void describe_input(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                    FlowReport& report)
{
    report.vertices = mesh.n_vertices();
    report.faces = mesh.n_faces();
    report.time_step = options.time_step;
    report.repaired_faces = cut.repaired_faces;
    report.remarks = cut.remarks;
    report.non_manifold_vertices =
        static_cast<Index>(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::NonManifold));
    if (report.non_manifold_vertices > 0)
        report.remarks.push_back(std::to_string(report.non_manifold_vertices) +
                                 " vertices are held fixed because the mesh is not manifold there.");
    if (cut.n_parts > 1 && options.steps > 0 && !options.tolerance) {
        const double width = width_in_diffusion_lengths(mesh, cut.n_parts, options.time_step);
        if (width < needs_of_sweeps.width)
            report.remarks.push_back("The sub-meshes are narrow against √dt (" + std::to_string(width).substr(0, 4) +
                                     " √dt on average, 10 are good): the result may drift from the undecomposed flow; "
                                     "use fewer sub-meshes.");
    }
}

/// Failures of `body` come out with a name before them.
template <class Body>
void named(const std::string& name, Body&& body)
{
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name + ", " + error.what());
    }
}

/// @param estimate in units of length; empty where the edges have no length to measure by.
void in_mean_edges(std::optional<double>& estimate, const PolygonMesh& mesh, const Points& positions)
{
    if (!estimate || *estimate == 0.0)
        return;
    *estimate /= mean_edge_length(mesh, positions, run_in_parallel);
    if (!std::isfinite(*estimate))
        estimate.reset();
}

/// What the estimate after the last step means for the user.
void remark_on_drift(const FlowOptions& options, FlowReport& report)
{
    if (report.steps.empty() || report.steps.back().estimated_v_max.value_or(0.0) <= 1.0)
        return;
    char estimate[32];
    std::snprintf(estimate, sizeof estimate, "%.2g", *report.steps.back().estimated_v_max);
    report.remarks.push_back("The result is, by estimate, up to " + std::string(estimate) +
                             " mean edge lengths away from the undecomposed flow: " +
                             (options.tolerance ? "a smaller tolerance brings it closer."
                                                : "fewer sub-meshes bring it closer; --converge "
                                                  "(FlowOptions::tolerance) gives the undecomposed step itself."));
}

template <class Flow>
void run_steps(PolygonMesh& mesh, const Topology& topology, const FlowOptions& options, const StepObserver& on_step,
               std::vector<double> curvature, Flow& flow, DecomposedFlow* reference, FlowReport& report)
{
    double curvature_before = largest_curvature(curvature);
    DisplacementMeter meter(mesh, topology);
    for (int step = 1; step <= options.steps; ++step) {
        Stopwatch watch;
        named("step " + std::to_string(step), [&] { flow.step(); });
        StepReport& of_step = report.steps.emplace_back();
        of_step.seconds = watch.lap();
        report.seconds.step += of_step.seconds;
        flow.describe(of_step);
        in_mean_edges(of_step.estimated_v_max, mesh, flow.positions());
        of_step.displacement = meter.add_step(mesh.vertices, flow.positions());
        mesh.vertices = flow.positions();

        curvature = measure_curvature(mesh, topology, flow.positions(), options.laplacian);
        of_step.max_mean_curvature_before = curvature_before;
        of_step.max_mean_curvature_after = curvature_before = largest_curvature(curvature);
        report.seconds.total += of_step.seconds + watch.lap();
        if (reference != nullptr) {
            named("step " + std::to_string(step) + " of the undecomposed flow", [&] { reference->step(); });
            of_step.reference_seconds = watch.lap();
            of_step.distance = vertex_distance(mesh, reference->positions(), flow.positions());
        }
        if (on_step)
            on_step({step, flow.positions(), of_step, flow.pieces(),
                     reference == nullptr ? nullptr : &reference->positions()});
    }
    remark_on_drift(options, report);
    report.displacement = meter.total();
    if (flow.pieces() != nullptr)
        report.pieces = *flow.pieces();
}

/// The whole mesh is one factor, which no limit for the sub-meshes fits.
FlowOptions without_limit(FlowOptions options)
{
    options.memory_limit.reset();
    return options;
}

void flow_with(const Workers& workers, PolygonMesh& mesh, FlowOptions options, const StepObserver& on_step,
               FlowReport& report)
{
    Stopwatch watch;
    require_valid(mesh, run_in_parallel);
    const ToleranceChoice choice = choose_tolerance(mesh, options);
    options.tolerance = choice.tolerance;
    const Topology topology = make_topology(mesh, run_in_parallel);
    require_sound_geometry(mesh, topology, options.laplacian, run_in_parallel);
    Cut cut;
    std::vector<double> curvature;
    // METIS has one thread: the others measure in the meantime.
    oneapi::tbb::parallel_invoke(
        [&] { cut = make_cut(mesh, topology, options); },
        [&] { curvature = measure_curvature(mesh, topology, mesh.vertices, options.laplacian); });
    // A whole mesh is solved exactly either way.
    if (cut.n_parts == 1 && !choice.reason.empty())
        options.tolerance.reset();
    else if (!choice.reason.empty())
        cut.remarks.insert(cut.remarks.begin(), "Steps are converged: " + choice.reason + ".");
    report.tolerance = options.tolerance;
    describe_input(mesh, topology, cut, options, report);
    report.threads = workers.threads();
    report.seconds.cut = watch.lap();

    const auto run = [&](auto&& flow) {
        report.labels = std::move(cut.labels);
        report.seconds.analyse = watch.lap();
        report.seconds.total = report.seconds.cut + report.seconds.analyse;
        std::optional<DecomposedFlow> reference;
        if (options.reference)
            reference.emplace(mesh, topology, cut_into(mesh, topology, 1), without_limit(options), curvature);
        run_steps(mesh, topology, options, on_step, curvature, flow, reference ? &*reference : nullptr, report);
        flow.describe(report);
    };
    if (options.scheme == Scheme::ExplicitEuler)
        run(ExplicitFlow(mesh, topology, options));
    else if (options.tolerance && is_symmetric(options.laplacian))
        run(ConvergedFlow(mesh, topology, cut, options));
    else if (options.tolerance)
        run(KrylovFlow(mesh, topology, cut, options));
    else
        run(DecomposedFlow(mesh, topology, cut, options, curvature));
}

}  // namespace

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step)
{
    require_valid(options);
    FlowReport report;
    Workers workers(options.threads);
    workers.execute([&] { flow_with(workers, mesh, options, on_step, report); });
    return report;
}

}  // namespace seamflow
