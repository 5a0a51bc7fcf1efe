#include "engine/flow/flow_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/flow_remarks.h"
#include "engine/measure/surface_measures.h"
#include "engine/state/transfer.h"
#include "engine/steppers/heat_stepper.h"
#include "engine/steppers/make_stepper.h"
#include "engine/steppers/undecomposed_stepper.h"
#include "engine/tasks/named.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/surface_distance.h"

namespace seamflow {

namespace {

/// The mean edge length of a sample of faces: good enough for an estimate.
double sampled_mean_edge(const PolygonMesh& mesh, const Points& positions)
{
    constexpr Index sample_size = 50'000;
    const Index stride = std::max(mesh.n_faces() / sample_size, Index{1});
    using Sum = Eigen::Array2d;
    const auto of_face = [&](Index i) -> Sum {
        const auto corners = mesh.face(i * stride);
        double length = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k)
            length += (positions.row(corners[k + 1 < corners.size() ? k + 1 : 0]) - positions.row(corners[k])).norm();
        return {length, static_cast<double>(corners.size())};
    };
    const Sum all = sum(run_in_parallel, (mesh.n_faces() + stride - 1) / stride, of_face, Sum(Sum::Zero()));
    return all[0] / all[1];
}

/// Converts an estimate to mean edge lengths.
/// @param estimate in units of length; emptied if no edge has a length.
void in_mean_edges(std::optional<double>& estimate, const PolygonMesh& mesh, const Points& positions)
{
    if (!estimate || *estimate == 0.0)
        return;
    *estimate /= sampled_mean_edge(mesh, positions);
    if (!std::isfinite(*estimate))
        estimate.reset();
}

}  // namespace

FlowRun::FlowRun(std::unique_ptr<PreparedFlow> prepared, Progress& progress, double setup, FlowReport& report,
                 const FlowControl& control)
    : SurfaceRun(prepared->surface, progress, report, control.resume.get())
    , prepared_(std::move(prepared))
    , flow_report_(report)
    , setup_(setup)
    , ranks_(control.ranks)
{
    const MotionOptions& motion = options().motion;
    make_steppers();
    vanishing_.emplace(mesh_.mesh(), topology_, settings_of(options(), plan().way, mesh_.mesh().vertices).equation,
                       options().scheme == Scheme::BackwardEuler);
    begin(motion, options().flow == FlowEquation::Conformalized, options().accuracy.largest_update, setup,
          options().steps, reference_ != nullptr);
    free_topology();
}

/// Frees those members of the topology that neither steps nor measurements need.
void FlowRun::free_topology()
{
    Topology& topology = prepared_->surface.topology;
    // Only Δ_P, which reaches two rings of faces, needs twins in later steps and measurements.
    if (traits_of(options().laplacian).reach == Reach::TwoRings)
        return;
    topology.twin = std::vector<Index>();
    topology.junctions = std::vector<JunctionLink>();
    // Steps in sub-meshes do not use the topology of the whole mesh.
    const bool is_whole = takes_whole_mesh(plan().way);
    const bool needs_normals = options().motion.direction.kind != MotionDirection::Kind::Any;
    if (is_whole || options().report.measures || constraints_->limited.has_value() || needs_normals)
        return;
    topology.vertex_offsets = std::vector<Index>();
    topology.vertex_corners = std::vector<Index>();
}

/// Begins the measurements, and makes the stepper; one without factorisations if these exceed the memory limit and the
/// plan has such an alternative. Makes also the stepper of the undecomposed flow, which takes the same steps without
/// sub-meshes for comparison, if it is asked for.
void FlowRun::make_steppers()
{
    const PolygonMesh& mesh = mesh_.mesh();
    Stopwatch watch;
    if (prepared_->meter)
        measure_by(std::move(*prepared_->meter), laplacian_of(options()),
                   prepared_->curvature.empty()
                       ? measure_largest_curvature(mesh, topology_, mesh.vertices, laplacian_of(options()))
                       : largest_curvature(prepared_->curvature));
    // Where making the reference, the stepper of the undecomposed flow, begins if there is one, as a fraction of the
    // set-up (an estimate).
    constexpr double begin_of_reference = 0.8;
    progress_.enter(FlowPhase::Analyse, 0, begin_of_steppers * setup_,
                    options().report.reference ? begin_of_reference * setup_ : setup_);
    try {
        make_stepper_of_flow();
    } catch (const MemoryLimitError&) {
        if (!prepared_->plan.without_factors)
            throw;
        leave_factors(prepared_->plan, mesh, topology_, progress_.exec());
        make_stepper_of_flow();
    }
    report_to(*prepared_, flow_report_);
    flow_report_.cut.labels = std::move(prepared_->plan.cut.labels);
    flow_report_.seconds.analyse = watch.lap();
    flow_report_.seconds.total = flow_report_.seconds.cut + flow_report_.seconds.analyse;
    if (options().report.reference) {
        progress_.enter(FlowPhase::Analyse, 0, begin_of_reference * setup_, setup_);
        const UndecomposedSteps way{.most_iterations = options().accuracy.converge_iterations};
        StepSettings settings = settings_of(options(), way, mesh.vertices);
        settings.factors.memory_limit.reset();
        reference_ = make_undecomposed_stepper(mesh, prepared_->surface.topology, settings, way, progress_);
    }
}

/// Makes the stepper of the plan, or one that shares the steps among ranks.
void FlowRun::make_stepper_of_flow()
{
    const PolygonMesh& mesh = mesh_.mesh();
    const StepSettings settings = settings_of(options(), plan().way, mesh.vertices);
    std::vector<double>& curvature = prepared_->curvature;
    stepper_ = ranks_ != nullptr && ranks_->can_share(plan(), settings)
                   ? ranks_->make_stepper(mesh, topology_, plan(), settings, std::move(curvature), progress_)
                   : make_stepper(mesh, topology_, plan().cut, plan().way, settings, std::move(curvature), progress_);
}

void FlowRun::restore(const FlowState& state)
{
    if (state.cut != checksum_of(flow_report_.cut.labels))
        throw InputError("the state to resume from belongs to another cut of the same mesh: another version of the "
                         "program made it, or one with another METIS");
    require_positions(state.flow);
    if (state.reference)
        require_positions(*state.reference);
    if (state.reference.has_value() != (reference_ != nullptr))
        throw InputError("the state to resume from does not have the undecomposed flow");
    if (reference_)
        reference_->restore(*state.reference);
    SurfaceRun::restore(state);
}

FlowState FlowRun::capture() const
{
    if (was_changed_)
        throw ComputationError("a flow that was changed between its steps has no state to resume from");
    FlowState state = SurfaceRun::capture();
    state.identity = prepared_->identity;
    state.approach = approach_of(plan().way);
    state.cut = checksum_of(flow_report_.cut.labels);
    if (resume_ != nullptr)
        state.seconds.add_tasks(resume_->seconds);
    stepper_->add_seconds(state.seconds);
    if (reference_)
        reference_->save(state.reference.emplace());
    return state;
}

void FlowRun::describe(StepReport& of_step) const
{
    stepper_->report_to(of_step);
    in_mean_edges(of_step.estimated_v_max, mesh_.mesh(), stepper_->positions());
}

/// Takes the same step without sub-meshes, and measures the distance between the two surfaces.
void FlowRun::compare(int step, StepReport& of_step)
{
    if (!reference_)
        return;
    progress_.enter(FlowPhase::Reference, step, fractions_->begin_of_reference(), fractions_->end());
    Stopwatch watch;
    const Points before = reference_->positions();
    const std::string name = "step " + std::to_string(step) + " of the undecomposed flow";
    named(name, [&] {
        vanishing_->step(*reference_, before);
        constraints_->direct(*reference_, before);
        constraints_->rescale(*reference_);
    });
    of_step.reference_seconds = watch.lap();
    PolygonMesh undecomposed = mesh_.mesh();
    undecomposed.vertices = reference_->positions();
    PolygonMesh decomposed = mesh_.mesh();
    decomposed.vertices = stepper_->positions();
    of_step.distance = vertex_distance(undecomposed, undecomposed.vertices, decomposed.vertices);
    of_step.surface_distance = surface_distance(undecomposed, decomposed, run_in_parallel);
    undecomposed_ = reference_->positions();
    named(name, [&] { constraints_->make_result(*reference_, undecomposed_); });
}

/// Calls the observer, and adds two results to the state: the separated sub-meshes, a mesh in which each sub-mesh has
/// its own copy of the vertices that it shares with others; and the positions of the undecomposed flow. The observer
/// gets all positions as those of the given mesh. state.positions are such positions already. The two results belong to
/// the mesh that flows, which may be a copy of the given mesh near the origin (see FlowingMesh), and are converted.
void FlowRun::show(const StepState& state, const StepObserver& on_step) const
{
    const PolygonMesh* separated = stepper_->separated();
    const Points* undecomposed = reference_ ? &undecomposed_ : nullptr;
    std::optional<Points> undecomposed_of_given;
    std::optional<PolygonMesh> separated_of_given;
    if (mesh_.is_elsewhere() && undecomposed != nullptr) {
        mesh_.bring_back(undecomposed_of_given.emplace(*undecomposed));
        undecomposed = &*undecomposed_of_given;
    }
    if (mesh_.is_elsewhere() && separated != nullptr) {
        mesh_.bring_back(separated_of_given.emplace(*separated));
        separated = &*separated_of_given;
    }
    on_step({.step = state.step,
             .positions = state.positions,
             .report = state.report,
             .separated = separated,
             .reference_positions = undecomposed,
             .capture = state.capture});
}

void FlowRun::complete(FlowReport& report) const
{
    remark_on_constraints(report, vanishing_->remark());
    remark_on_drift(report);
    report_measures(report);
    if (stepper_->separated() != nullptr)
        report.separated = *stepper_->separated();
    stepper_->report_to(report);
    remark_on_factorisation(options().resources.factorisation, report);
    remark_on_near_singularity(report);
    if (resume_ != nullptr)
        report.seconds.add_tasks(resume_->seconds);
    if (report.separated && mesh_.is_elsewhere())
        mesh_.bring_back(*report.separated);
    mesh_.complete(report);
    report.cut.labels = mesh_.labels_of_given(std::move(report.cut.labels), report.cut.n_sub_meshes());
}

}  // namespace seamflow
