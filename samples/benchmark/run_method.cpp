#include "samples/benchmark/run_method.h"

#include <memory>
#include <utility>

#include "engine/mean_curvature_flow.h"
#include "engine/options/option_names.h"
#include "engine/tasks/stopwatch.h"
#include "samples/benchmark/methods/fused_cg.h"
#include "samples/benchmark/methods/peer_solver.h"
#include "samples/benchmark/methods/smooth_shape.h"

namespace seamflow {

namespace {

/// The options of a task for the approach of its method. As with other methods, steps are not measured.
FlowOptions options_of(const MethodTask& task)
{
    FlowOptions options = task.options;
    options.report.measures = false;
    if (task.method == Method::OurSweep) {
        options.accuracy.approach = Approach::Sweep;
        options.accuracy.tolerance.reset();
    }
    if (task.method == Method::OurConverged)
        options.accuracy.approach = Approach::Converged;
    if (task.method == Method::OurCg)
        options.accuracy.approach = Approach::ConjugateGradients;
    if (task.method == Method::Undecomposed)
        options.accuracy.approach = Approach::Undecomposed;
    return options;
}

MethodResult run_ours(PolygonMesh mesh, const MethodTask& task)
{
    FlowOptions options = options_of(task);
    options.report.record_schedule = !task.simulated_threads.empty();
    const FlowReport report = mean_curvature_flow(mesh, options);
    MethodResult result;
    result.setup_seconds = report.seconds.cut + report.seconds.analyse;
    for (const StepReport& step : report.steps) {
        result.steps.push_back({.total = step.seconds});
        result.iterations += step.iterations.value_or(0);
    }
    const auto n_steps = static_cast<double>(report.steps.size());
    result.phases.assemble = report.seconds.assemble / n_steps;
    result.phases.prepare = report.seconds.factorise / n_steps;
    result.phases.solve = (report.seconds.solve + report.seconds.correct) / n_steps;
    result.phases.total = result.step_seconds();
    for (const int threads : task.simulated_threads)
        result.simulations.push_back(
            simulate(*report.schedule, static_cast<int>(median_step(result.steps)) + 1, threads));
    result.subdomains = report.cut.n_sub_meshes();
    result.approach = option_name(report.convergence.approach);
    result.remarks = report.remarks;
    result.positions = std::move(mesh.vertices);
    return result;
}

MethodResult run_peer(const PolygonMesh& mesh, const MethodTask& task)
{
    MethodResult result;
    const std::unique_ptr<PeerSolver> solver = make_peer_solver(task);
    Stopwatch watch;
    const Topology topology = make_topology(mesh);
    WholeSystem system(mesh, topology, task.options.laplacian, solver->form(), solver->order());
    solver->analyse(system);
    result.setup_seconds = watch.lap();

    const Point centroid = mesh.vertices.colwise().mean();
    result.positions = mesh.vertices.rowwise() - centroid;
    for (int step = 0; step < task.options.steps; ++step) {
        StepSeconds& seconds = result.steps.emplace_back();
        watch.lap();
        system.assemble(result.positions, task.options.time_step);
        seconds.assemble = watch.lap();
        solver->prepare(system);
        seconds.prepare = watch.lap();
        Columns unknowns = system.unknowns_at(result.positions);
        result.iterations += solver->solve(system, unknowns);
        system.move(unknowns, result.positions);
        seconds.solve = watch.lap();
        seconds.total = seconds.assemble + seconds.prepare + seconds.solve;
    }
    result.positions.rowwise() += centroid;
    result.phases = result.steps[median_step(result.steps)];
    return result;
}

}  // namespace

MethodResult run_method(PolygonMesh mesh, const MethodTask& task)
{
    if (is_ours(task.method))
        return run_ours(std::move(mesh), task);
    if (task.method == Method::SmoothShape)
        return run_smooth_shape(mesh, task);
    if (task.method == Method::Krylov && is_symmetric(task.options.laplacian))
        return run_fused_cg(mesh, task);
    return run_peer(mesh, task);
}

}  // namespace seamflow
