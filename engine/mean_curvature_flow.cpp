#include "engine/mean_curvature_flow.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/choose_subdomains.h"
#include "engine/choose_tolerance.h"
#include "engine/constraints.h"
#include "engine/converged_flow.h"
#include "engine/cut_and_measure.h"
#include "engine/decomposed_flow.h"
#include "engine/displacement_meter.h"
#include "engine/explicit_flow.h"
#include "engine/flow_remarks.h"
#include "engine/flow_state.h"
#include "engine/krylov_flow.h"
#include "engine/mesh_size.h"
#include "engine/near_origin.h"
#include "engine/parallel_loop.h"
#include "engine/progress.h"
#include "engine/repeated_faces_left_out.h"
#include "engine/rescaling.h"
#include "engine/step_shares.h"
#include "engine/stopwatch.h"
#include "engine/surface_curvature.h"
#include "engine/update_limit.h"
#include "engine/workers.h"
#include "partition/cut/cut.h"
#include "partition/errors.h"
#include "partition/topology.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

void describe_input(const PolygonMesh& mesh, const MeshSize& size, const Topology& topology, const Cut& cut,
                    const FlowOptions& options, FlowReport& report)
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
    report.fixed_vertices = static_cast<Index>(std::count(topology.fixed.begin(), topology.fixed.end(), 1));
    if (cut.n_parts > 1 && options.steps > 0 && !options.tolerance) {
        const double width = width_in_diffusion_lengths(size.area, cut.n_parts, options.time_step);
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

/// What the parts of a flow have to do with.
struct Run {
    PolygonMesh& mesh;
    /// Half-edges lose their twins when nobody asks for them any more.
    Topology& topology;
    DisplacementMeter& meter;
    const FlowOptions& options;
    const StepObserver& on_step;
    const FlowState* resume;
    const FlowIdentity& identity;
    Progress& progress;
    FlowReport& report;
};

/// Adds what was spent in tasks.
void add_task_seconds(PhaseSeconds& seconds, const PhaseSeconds& further)
{
    seconds.assemble += further.assemble;
    seconds.factorise += further.factorise;
    seconds.solve += further.solve;
    seconds.correct += further.correct;
    seconds.interface += further.interface;
}

template <class Flow>
FlowState capture(const Run& run, const Flow& flow, const DecomposedFlow* reference, const DisplacementMeter& meter)
{
    FlowState state{
        .identity = run.identity,
        .cut = checksum_of(run.report.labels),
        .steps = run.report.steps,
        .seconds = {.step = run.report.seconds.step,
                    .total = run.report.seconds.total - run.report.seconds.cut - run.report.seconds.analyse},
        .displacement = meter.sums()};
    if (run.resume != nullptr)
        add_task_seconds(state.seconds, run.resume->seconds);
    flow.add_seconds(state.seconds);
    flow.save(state.flow);
    if (reference != nullptr)
        reference->save(state.reference.emplace());
    return state;
}

/// Brings everything to where it was after a step.
template <class Flow>
void restore(const Run& run, Flow& flow, DecomposedFlow* reference, const Rescaling& rescaling,
             DisplacementMeter& meter)
{
    const FlowState& state = *run.resume;
    if (state.cut != checksum_of(run.report.labels))
        throw InputError("the state to go on from belongs to another cut of the same mesh: another version of the "
                         "program made it, or one with another METIS");
    for (const StepMemory* memory : {&state.flow, state.reference ? &*state.reference : nullptr}) {
        if (memory == nullptr)
            continue;
        if (memory->positions.rows() != run.mesh.vertices.rows())
            throw InputError("the state to go on from has not the vertices of this mesh");
        if (!memory->positions.allFinite())
            throw InputError("the state to go on from has positions that are not finite: it has been changed");
    }
    if (state.reference.has_value() != (reference != nullptr))
        throw InputError("the state to go on from has not the undecomposed flow");
    flow.restore(state.flow);
    if (reference != nullptr)
        reference->restore(*state.reference);
    Points rescaled = flow.positions();
    rescaling.apply(rescaled);
    run.mesh.vertices.swap(rescaled);
    meter.restore(state.displacement, run.mesh.vertices);
    run.report.steps = state.steps;
    run.report.seconds.step = state.seconds.step;
    run.report.seconds.total += state.seconds.total;
}

/// Takes the same step with the whole mesh.
void compare_with(DecomposedFlow& reference, const Run& run, int step, const StepShares& shares,
                  const Points& positions, StepReport& of_step)
{
    run.progress.enter(FlowPhase::Reference, step, shares.begin_of_reference(), shares.end());
    Stopwatch watch;
    named("step " + std::to_string(step) + " of the undecomposed flow", [&] { reference.step(reference.positions()); });
    of_step.reference_seconds = watch.lap();
    of_step.distance = vertex_distance(run.mesh, reference.positions(), positions);
}

/// One step after the other. The mesh moves when a step is complete, with that of the undecomposed flow.
template <class Flow>
void run_steps(const Run& run, double curvature_before, Flow& flow, DecomposedFlow* reference, double begin)
{
    const auto& [mesh, topology, meter, options, on_step, resume, identity, progress, report] = run;
    const double extent = extent_of(mesh.vertices);
    const UpdateLimit limit(mesh, options.largest_update);
    const Rescaling rescaling(mesh, topology, options.rescale);
    // The others' mean curvature is measured across edges.
    if (traits_of(options.laplacian).reach != Reach::TwoRings)
        topology.twin = std::vector<Index>();
    if (resume != nullptr)
        restore(run, flow, reference, rescaling, meter);
    const auto first = static_cast<int>(report.steps.size()) + 1;
    if (!report.steps.empty())
        curvature_before = report.steps.back().max_mean_curvature_after;
    StepShares shares(begin, std::max(options.steps - first + 1, 1), reference != nullptr);
    const bool is_rescaled = options.rescale != Rescale::None;
    // Steps begin where the last one ended before it was rescaled.
    Points unscaled = is_rescaled ? flow.positions() : Points();
    const Points& before = is_rescaled ? unscaled : mesh.vertices;
    Points rescaled;
    Points undecomposed;
    for (int step = first; step <= options.steps; ++step) {
        progress.enter(FlowPhase::Step, step, shares.begin(), shares.end_of_tasks());
        Stopwatch watch;
        named("step " + std::to_string(step), [&] { flow.step(before); });
        StepReport of_step;
        of_step.seconds = watch.lap();
        flow.describe(of_step);
        in_mean_edges(of_step.estimated_v_max, mesh, flow.positions());
        // Scaling could hide that vertices have been thrown away, or make too little of what is left.
        named("step " + std::to_string(step), [&] {
            limit.require(before, flow.positions(), run.report.labels);
            if (is_rescaled) {
                unscaled = rescaled = flow.positions();
                rescaling.apply(rescaled);
            }
        });
        const Points& after = is_rescaled ? rescaled : flow.positions();
        of_step.displacement = meter.add_step(mesh.vertices, after);
        of_step.max_mean_curvature_before = curvature_before;
        of_step.max_mean_curvature_after = curvature_before =
            measure_largest_curvature(mesh, topology, after, options.laplacian);
        const double measuring = watch.lap();
        if (reference != nullptr) {
            compare_with(*reference, run, step, shares, flow.positions(), of_step);
            undecomposed = reference->positions();
            named("step " + std::to_string(step) + " of the undecomposed flow", [&] { rescaling.apply(undecomposed); });
        }
        shares.end_step(of_step.seconds, measuring, of_step.reference_seconds.value_or(0.0));

        // What takes memory comes first: the mesh moves when nothing but the observer can fail any more.
        const StepState state{
            step, mesh.vertices, of_step, flow.pieces(), reference == nullptr ? nullptr : &undecomposed, [&] {
                return capture(run, flow, reference, run.meter);
            }};
        report.steps.push_back(of_step);
        report.seconds.step += of_step.seconds;
        report.seconds.total += of_step.seconds + measuring;
        mesh.vertices = after;
        if (on_step)
            on_step(state);
    }
    remark_on_drift(options, report);
    remark_on_collapse(extent, mesh.vertices, report);
    report.displacement = meter.total();
    if (flow.pieces() != nullptr)
        report.pieces = *flow.pieces();
    flow.describe(report);
    if (resume != nullptr)
        add_task_seconds(report.seconds, resume->seconds);
}

/// The whole mesh is one factor, which no limit for the sub-meshes fits.
FlowOptions without_limit(FlowOptions options)
{
    options.memory_limit.reset();
    return options;
}

/// Setup takes as long as so many steps, about.
double fraction_of_setup(const FlowOptions& options, const FlowState* resume)
{
    const double as_steps = options.tolerance ? 4.0 : options.scheme == Scheme::ExplicitEuler ? 3.0 : 6.0;
    const double to_do = options.steps - (resume != nullptr ? resume->n_steps() : 0);
    return as_steps / (as_steps + to_do);
}

/// The checks, and what tells the flow from others where that is needed.
FlowIdentity require_sound(const PolygonMesh& mesh, const FlowOptions& options, bool is_observed,
                           const FlowState* resume, Progress& progress)
{
    require_valid(mesh, progress.loop());
    progress.count();
    if (resume == nullptr && !is_observed)
        return {};
    FlowIdentity identity = identify(mesh, options);
    if (resume != nullptr)
        require_same(resume->identity, identity);
    progress.count();
    return identity;
}

void flow_with(const Workers& workers, PolygonMesh& mesh, FlowOptions options, const StepObserver& on_step,
               const FlowControl& control, FlowReport& report)
{
    Stopwatch watch;
    const FlowState* const resume = control.resume.get();
    Progress progress(control);
    progress.set_steps(options.steps);
    const double setup = fraction_of_setup(options, resume);
    progress.enter(FlowPhase::Cut, 0, 0.0, 0.6 * setup);
    progress.expect(8.0);
    const FlowIdentity identity = require_sound(mesh, options, static_cast<bool>(on_step), resume, progress);
    std::vector<std::string> remarks;
    Topology topology;
    MeshSize size;
    // Part of the topology is made by one thread.
    const auto examine = [&] {
        remarks.clear();
        run_both([&] { topology = make_constrained_topology(mesh, options, progress.loop(), remarks); },
                 [&] { size = size_of(mesh); });
    };
    examine();
    const RepeatedFacesLeftOut left_out(mesh, topology, options);
    if (left_out.count() > 0)
        examine();
    progress.count();
    const ToleranceChoice choice = choose_tolerance(mesh, size, options, boundary_moves(mesh, topology));
    options.tolerance = choice.tolerance;
    progress.count();
    Measured measured;
    Cut cut = cut_and_measure(mesh, size, topology, choice, options, measured, progress);
    cut.remarks.insert(cut.remarks.end(), remarks.begin(), remarks.end());
    if (!options.tolerance && options.scheme == Scheme::BackwardEuler)
        require_boundary_unshared(mesh, topology, cut);
    report.tolerance = options.tolerance;
    describe_input(mesh, size, topology, cut, options, report);
    report.threads = workers.threads();
    report.seconds.cut = watch.lap();
    progress.enter(FlowPhase::Analyse, 0, 0.6 * setup, options.reference ? 0.8 * setup : setup);

    const Run run{mesh, topology, *measured.meter, options, on_step, resume, identity, progress, report};
    const auto run_with = [&](auto&& flow) {
        report.labels = std::move(cut.labels);
        report.seconds.analyse = watch.lap();
        report.seconds.total = report.seconds.cut + report.seconds.analyse;
        std::optional<DecomposedFlow> reference;
        if (options.reference) {
            progress.enter(FlowPhase::Analyse, 0, 0.8 * setup, setup);
            reference.emplace(mesh, topology, cut_into(mesh, topology, 1), without_limit(options), measured.curvature,
                              progress);
        }
        const double curvature_before = largest_curvature(measured.curvature);
        measured.curvature = std::vector<double>();
        run_steps(run, curvature_before, flow, reference ? &*reference : nullptr, setup);
        left_out.complete(report);
        progress.finish();
    };
    if (options.scheme == Scheme::ExplicitEuler)
        run_with(ExplicitFlow(mesh, topology, options, progress));
    else if (options.tolerance && is_symmetric(options.laplacian))
        run_with(ConvergedFlow(mesh, topology, cut, options, progress));
    else if (options.tolerance)
        run_with(KrylovFlow(mesh, topology, cut, options, progress));
    else
        run_with(DecomposedFlow(mesh, topology, cut, options, measured.curvature, progress));
}

/// @throws OptionError if it is beyond the last step that is wanted.
void require_ahead(const FlowOptions& options, const FlowState& state)
{
    if (state.n_steps() > options.steps)
        throw OptionError("steps is " + std::to_string(options.steps) + ", but the state to go on from is after step " +
                          std::to_string(state.n_steps()) + " already: ask for as many at least, or begin anew");
}

}  // namespace

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                               const FlowControl& control)
{
    require_valid(options);
    if (control.resume != nullptr)
        require_ahead(options, *control.resume);
    FlowReport report;
    Workers workers(options.threads);
    const auto flow = [&](const StepObserver& observer) {
        workers.execute([&] { flow_with(workers, mesh, options, observer, control, report); });
    };
    const Point offset = offset_of(mesh);
    if (offset.isZero(0.0)) {
        flow(on_step);
        return report;
    }
    const NearOrigin near(mesh, offset);
    flow(near.observing(on_step));
    if (report.pieces)
        report.pieces = near.brought_back(*std::move(report.pieces));
    return report;
}

}  // namespace seamflow
