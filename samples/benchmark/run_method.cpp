#include "samples/benchmark/run_method.h"

#include <memory>
#include <utility>

#include "engine/mean_curvature_flow.h"
#include "engine/options/option_names.h"
#include "engine/tasks/stopwatch.h"
#include "samples/benchmark/methods/fused_cg.h"
#include "samples/benchmark/methods/peer_solver.h"

namespace seamflow {

namespace {

/// As with other methods, steps are not measured.
MethodResult run_ours(PolygonMesh mesh, const MethodTask& task)
{
    FlowOptions options = task.options;
    options.report.measures = false;
    const FlowReport report = mean_curvature_flow(mesh, options);
    MethodResult result;
    result.setup_seconds = report.seconds.cut + report.seconds.analyse;
    for (const StepReport& step : report.steps) {
        result.steps.push_back(step.seconds);
        result.iterations += step.iterations.value_or(0);
    }
    result.approach = option_name(report.convergence.approach);
    result.positions = std::move(mesh.vertices);
    return result;
}

MethodResult run_solver(const PolygonMesh& mesh, const MethodTask& task, PeerSolver& solver)
{
    MethodResult result;
    Stopwatch watch;
    const Topology topology = make_topology(mesh);
    WholeSystem system(mesh, topology, task.options.laplacian);
    solver.analyse(system);
    result.setup_seconds = watch.lap();

    const Point centroid = mesh.vertices.colwise().mean();
    result.positions = mesh.vertices.rowwise() - centroid;
    for (int step = 0; step < task.options.steps; ++step) {
        watch.lap();
        system.assemble(result.positions, task.options.time_step);
        solver.prepare(system);
        Columns unknowns = system.unknowns_at(result.positions);
        result.iterations += solver.solve(system, unknowns);
        system.move(unknowns, result.positions);
        result.steps.push_back(watch.lap());
    }
    result.positions.rowwise() += centroid;
    return result;
}

}  // namespace

MethodResult run_method(PolygonMesh mesh, const MethodTask& task)
{
    switch (task.method) {
    case Method::Ours:
        return run_ours(std::move(mesh), task);
    case Method::Gradients:
        return run_fused_cg(mesh, task);
    case Method::Cholmod:
        return run_solver(mesh, task, *make_cholmod_solver());
    case Method::Amg:
        return run_solver(mesh, task, *make_amg_solver(task.tolerance));
    }
    return failed("unknown method");
}

}  // namespace seamflow
