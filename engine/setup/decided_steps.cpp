#include "engine/setup/decided_steps.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/cut/cut_into.h"

namespace seamflow {

namespace {

/// Cuts the mesh.
/// @param choices gets a sentence if the number of sub-meshes is chosen.
Cut make_cut(const PolygonMesh& mesh, const Surface& surface, const FlowOptions& options, const Executor& exec,
             const Alongside& alongside, std::vector<Remark>& choices)
{
    const Topology& topology = surface.topology;
    if (options.scheme == Scheme::ExplicitEuler || takes_whole_mesh(options.accuracy.approach))
        return cut_into(mesh, topology, 1, exec);
    if (!options.cut.labels.empty())
        return cut_by_labels(mesh, topology, options.cut.labels, exec);
    if (options.cut.subdomains > 0)
        return cut_into(mesh, topology, options.cut.subdomains, exec, alongside);
    const SubdomainChoice choice = choose_subdomains(
        surface.size, options.time_step, needs_of(options.laplacian, options.accuracy.tolerance.has_value()));
    choices.push_back({"sub-meshes", {{"sub-meshes", choice.count}}, {choice.reason + "."}});
    return cut_into(mesh, topology, choice.count, exec, alongside);
}

Remark choice_of(const ApproachChoice& choice)
{
    Remark::Numbers numbers;
    if (choice.tolerance)
        numbers.emplace_back("tolerance", *choice.tolerance);
    return {"approach", numbers, {choice.reason}};
}

/// METIS has one thread: other threads measure in the meantime. If METIS is not needed, measuring comes afterwards.
void cut_and_measure(const PolygonMesh& mesh, const Surface& surface, const FlowOptions& options, const Executor& exec,
                     const std::function<void()>& measure, DecidedSteps& steps)
{
    bool is_measured = false;
    const auto measure_once = [&] {
        is_measured = true;
        measure();
    };
    steps.cut = make_cut(
        mesh, surface, options, exec, [&](const std::function<void()>& serial) { run_both(serial, measure_once); },
        steps.choices);
    if (!is_measured)
        measure();
}

}  // namespace

double fraction_of_setup(const FlowOptions& options, int n_taken)
{
    const bool is_simple = options.scheme == Scheme::ExplicitEuler;
    const double as_steps = options.accuracy.tolerance ? 4.0 : is_simple ? 3.0 : 6.0;
    const double to_do = options.steps - n_taken;
    return as_steps / (as_steps + to_do);
}

DecidedSteps decide_steps(const PolygonMesh& mesh, const Surface& surface, FlowOptions& options,
                          std::optional<Approach> earlier, Sharing sharing, Progress& progress,
                          const std::function<void()>& measure)
{
    DecidedSteps steps;
    steps.choices = surface.choices;
    steps.remarks = surface.remarks;
    // Steps continue in the way in which they began.
    if (options.resources.memory_limit && !earlier && sharing == Sharing::None)
        steps.without_factors = choose_without_factors(surface.size, options);
    if (steps.without_factors) {
        steps.choices_without_factors = {choice_of(*steps.without_factors)};
        std::ranges::copy(steps.choices, std::back_inserter(steps.choices_without_factors));
    }
    const ApproachChoice choice = choose_approach(mesh, surface.topology, surface.size, options, earlier, sharing);
    AccuracyOptions& accuracy = options.accuracy;
    accuracy.approach = choice.approach;
    accuracy.tolerance = choice.tolerance;
    if (!choice.costs.empty())
        steps.costs = choice.size;
    progress.count();
    cut_and_measure(mesh, surface, options, progress.exec(), measure, steps);
    steps.remarks.insert(steps.remarks.begin(), steps.cut.remarks.begin(), steps.cut.remarks.end());
    // A single sub-mesh is solved exactly, whatever the approach.
    if (steps.cut.n_parts == 1 && accuracy.approach == Approach::Converged && !choice.reason.empty()) {
        accuracy.approach = Approach::Undecomposed;
        accuracy.tolerance.reset();
    } else if (!choice.reason.empty()) {
        steps.choices.insert(steps.choices.begin(), choice_of(choice));
    }
    return steps;
}

void leave_factors(DecidedSteps& steps, FlowOptions& options, const PolygonMesh& mesh, const Topology& topology,
                   const Executor& exec)
{
    options.accuracy.approach = steps.without_factors->approach;
    options.accuracy.tolerance = steps.without_factors->tolerance;
    steps.cut = cut_into(mesh, topology, 1, exec);
    steps.choices = std::move(steps.choices_without_factors);
    // No factors are to be made in later steps either.
    steps.costs.reset();
}

void report_to(const DecidedSteps& steps, const Surface& surface, const FlowOptions& options, const FlowingMesh& mesh,
               std::string_view need_of_junctions, FlowReport& report)
{
    report.mesh = report_on(surface, mesh, options.motion.strength);
    report.time_step = options.time_step;
    report.convergence.approach = options.accuracy.approach;
    report.convergence.tolerance = options.accuracy.tolerance;
    report.cut.repaired_faces = steps.cut.repaired_faces;
    report.choices = steps.choices;
    report.remarks = steps.remarks;
    if (report.mesh.non_manifold_vertices > 0)
        report.remarks.push_back(remark_on_non_manifold_vertices(report.mesh.non_manifold_vertices, need_of_junctions));
    if (report.mesh.junction_vertices > 0)
        report.remarks.push_back(remark_on_junctions(report.mesh.junction_vertices, options.laplacian));
}

}  // namespace seamflow
