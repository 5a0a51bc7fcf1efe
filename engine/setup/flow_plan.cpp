#include "engine/setup/flow_plan.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/cut/cut_into.h"

namespace seamflow {

namespace {

/// Cuts the mesh for an approach.
/// @param choices gets a sentence if the number of sub-meshes is chosen.
Cut make_cut(const Surface& surface, const FlowOptions& options, const ApproachChoice& approach, const Executor& exec,
             const Alongside& alongside, std::vector<Remark>& choices)
{
    const PolygonMesh& mesh = surface.mesh.mesh();
    const Topology& topology = surface.topology;
    if (options.scheme != Scheme::BackwardEuler || takes_whole_mesh(approach.approach))
        return cut_into(mesh, topology, 1, exec);
    if (!options.cut.labels.empty())
        return cut_by_labels(mesh, topology, options.cut.labels, exec);
    if (options.cut.subdomains > 0)
        return cut_into(mesh, topology, options.cut.subdomains, exec, alongside);
    const SubdomainChoice choice =
        choose_subdomains(surface.size, options.time_step, needs_of(options.laplacian, approach.tolerance.has_value()));
    choices.push_back({"sub-meshes", {{"sub-meshes", choice.count}}, {choice.reason + "."}});
    return cut_into(mesh, topology, choice.count, exec, alongside);
}

/// The remark that tells the user why this approach was chosen.
Remark remark_on(const ApproachChoice& choice)
{
    Remark::Numbers numbers;
    if (choice.tolerance)
        numbers.emplace_back("tolerance", *choice.tolerance);
    return {"approach", numbers, {choice.reason}};
}

/// METIS has one thread: other threads measure in the meantime. If METIS is not needed, measuring comes afterwards.
void cut_and_measure(const Surface& surface, const FlowOptions& options, const ApproachChoice& choice,
                     const Executor& exec, const std::function<void()>& measure, FlowPlan& plan)
{
    bool is_measured = false;
    const auto measure_once = [&] {
        is_measured = true;
        measure();
    };
    plan.cut = make_cut(
        surface, options, choice, exec, [&](const std::function<void()>& serial) { run_both(serial, measure_once); },
        plan.choices);
    if (!is_measured)
        measure();
}

/// The conditions on Γ that the options ask for, with all parameters that they leave open.
InterfaceConditions conditions_of(const FlowOptions& options)
{
    const InterfaceOptions& interface = options.interface;
    const RobinChoice p =
        interface.p ? RobinChoice(*interface.p)
                    : OptimalRobin{.eta = interface.p_rule == PRule::InverseStep ? 1.0 / options.time_step : 1.0,
                                   .edge = interface.p_edge};
    const double q = interface.q.value_or(0.0);
    if (interface.conditions == Conditions::Schwarz)
        return SchwarzConditions{interface.overlap};
    if (is_classical(interface.conditions))
        return ClassicalConditions{.p = p, .q = q, .keeps_gaps = options.report.keep_gaps};
    if (predicts(options))
        return PredictedTransmission{};
    return AdaptedConditions{.p = p, .q = q};
}

/// The way of taking steps that the approach and the options amount to.
/// @param n_sub_meshes the number in the cut.
WayOfSteps way_of(const ApproachChoice& choice, const FlowOptions& options, Index n_sub_meshes)
{
    if (options.scheme == Scheme::ExplicitEuler)
        return ExplicitSteps{};
    const int most_iterations = options.accuracy.converge_iterations;
    if (choice.approach == Approach::ConjugateGradients)
        // Chosen by cost, and without a filter, steps may begin with a factorisation later (see SwitchingStepper).
        return GradientSteps{.stop = {choice.tolerance.value(), most_iterations},
                             .costs = choice.costs.empty() || !filter_of(options).is_plain()
                                          ? std::nullopt
                                          : std::optional(choice.size)};
    // A single sub-mesh is solved exactly. An approach that the options ask for, which has no reason, is kept.
    if (choice.approach == Approach::Converged && n_sub_meshes == 1 && !choice.reason.empty())
        return UndecomposedSteps{.most_iterations = most_iterations};
    if (choice.approach == Approach::Undecomposed)
        return UndecomposedSteps{.tolerance = choice.tolerance, .most_iterations = most_iterations};
    if (choice.tolerance)
        return ConvergedSteps{{*choice.tolerance, most_iterations}};
    return sweeps_of(options, n_sub_meshes);
}

}  // namespace

double fraction_of_setup(const FlowOptions& options, int n_taken)
{
    const bool is_simple = options.scheme != Scheme::BackwardEuler;
    const double as_steps = options.accuracy.tolerance ? 4.0 : is_simple ? 3.0 : 6.0;
    const double to_do = options.steps - n_taken;
    return as_steps / (as_steps + to_do);
}

FlowPlan decide(const Surface& surface, const FlowOptions& options, std::optional<Approach> earlier, Sharing sharing,
                Progress& progress, const std::function<void(Approach)>& measure)
{
    FlowPlan plan;
    // Steps continue in the way in which they began.
    if (options.resources.memory_limit && !earlier && sharing == Sharing::None)
        if (const auto choice = choose_without_factors(surface.size, options))
            plan.without_factors = {.way = {{*choice->tolerance, options.accuracy.converge_iterations}},
                                    .choices = {remark_on(*choice)}};
    if (plan.without_factors)
        std::ranges::copy(surface.choices, std::back_inserter(plan.without_factors->choices));
    plan.choices = surface.choices;
    plan.remarks = surface.remarks;
    const ApproachChoice choice =
        choose_approach(surface.mesh.mesh(), surface.topology, surface.size, options, earlier, sharing);
    progress.count();
    cut_and_measure(
        surface, options, choice, progress.exec(), [&] { measure(choice.approach); }, plan);
    plan.remarks.insert(plan.remarks.begin(), plan.cut.remarks.begin(), plan.cut.remarks.end());
    plan.way = way_of(choice, options, plan.cut.n_parts);
    if (!choice.reason.empty() && approach_of(plan.way) == choice.approach)
        plan.choices.insert(plan.choices.begin(), remark_on(choice));
    return plan;
}

void leave_factors(FlowPlan& plan, const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    // This way has no GradientSteps::costs, so that no SwitchingStepper factorises in a later step either.
    plan.way = plan.without_factors->way;
    plan.cut = cut_into(mesh, topology, 1, exec);
    plan.choices = std::move(plan.without_factors->choices);
}

SweepSteps sweeps_of(const FlowOptions& options, Index n_sub_meshes)
{
    const InterfaceOptions& interface = options.interface;
    const bool may_alternate = interface.conditions != Conditions::Schwarz;
    const bool is_adapted = may_alternate && !is_classical(interface.conditions);
    return {.conditions = conditions_of(options),
            .solves_in_order_of_numbers = interface.colouring == Colouring::Label,
            .alternates = may_alternate && (interface.sweep == Sweep::Alternating ||
                                            (interface.sweep == Sweep::Automatic && n_sub_meshes > 2)),
            .corrects = interface.correction == Correction::Centroid ||
                        (interface.correction == Correction::Automatic && is_adapted)};
}

StepSettings settings_of(const FlowOptions& options, const WayOfSteps& way, const Points& initial)
{
    const FlowTerms terms{.initial = &initial,
                          .keeps_stiffness = options.flow != FlowEquation::MeanCurvature,
                          .keeps_mass = options.flow == FlowEquation::Linear,
                          .weights = options.motion.attachment_weights,
                          .uniform_weight = options.motion.attachment,
                          .strengths = options.motion.strength};
    return {.equation = {.laplacian = laplacian_of(options),
                         .filter = filter_of(options, approach_of(way), tolerance_of(way)),
                         .time_step = options.time_step,
                         .terms = terms},
            .factors = {.factorisation = options.resources.factorisation,
                        .precision = options.resources.precision,
                        .memory_limit = options.resources.memory_limit},
            .records_schedule = options.report.record_schedule};
}

void report_to(const FlowPlan& plan, const Surface& surface, const FlowOptions& options,
               std::string_view need_of_junctions, FlowReport& report)
{
    report.mesh = report_on(surface, options.motion.strength);
    report.time_step = options.time_step;
    report.convergence.approach = approach_of(plan.way);
    report.convergence.tolerance = tolerance_of(plan.way);
    report.cut.repaired_faces = plan.cut.repaired_faces;
    report.choices = plan.choices;
    report.remarks = plan.remarks;
    if (report.mesh.non_manifold_vertices > 0)
        report.remarks.push_back(remark_on_non_manifold_vertices(report.mesh.non_manifold_vertices, need_of_junctions));
    if (report.mesh.junction_vertices > 0)
        report.remarks.push_back(remark_on_junctions(report.mesh.junction_vertices, options.laplacian));
}

}  // namespace seamflow
