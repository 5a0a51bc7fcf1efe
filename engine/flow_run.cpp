#include "engine/flow_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/remarks.h"
#include "engine/measure/surface_measures.h"
#include "engine/ranks/rank_stepper.h"
#include "engine/state/archive.h"
#include "engine/step_constraints.h"
#include "engine/steppers/make_stepper.h"
#include "engine/steppers/switching_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/surface_distance.h"

namespace seamflow {

namespace {

/// Prefixes failures of `body` with a name.
template <class Body>
void named(const std::string& name, Body&& body)
{
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name + ", " + error.what());
    }
}

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

/// @throws InputError if a state does not fit the mesh.
void require_positions(const StepMemory& memory, const PolygonMesh& mesh)
{
    if (memory.positions.rows() != mesh.vertices.rows())
        throw InputError("the state to resume from does not have the vertices of this mesh");
    if (!memory.positions.allFinite())
        throw InputError("the state to resume from has positions that are not finite: it has been changed");
}

}  // namespace

/// Where the phases of the steps begin and end within a whole flow, as fractions. The whole ends with the expected
/// number of steps, however many follow. All steps are assumed to take equally long; a step is divided in the ratios of
/// the previous one.
class FlowRun::StepFractions {
  public:
    /// @param begin the fraction of the whole that is done before the first step.
    /// @param steps the expected number of steps.
    StepFractions(double begin, int steps, bool with_reference)
        : begin_(begin)
        , length_((1.0 - begin) / steps)
        , tasks_(with_reference ? 0.3 : 0.9)
        , reference_(with_reference ? 0.6 : 0.0)
    {
    }

    /// Fractions of the whole: the beginning of the step, the end of its tasks, the beginning of its reference step,
    /// and the end of the step.
    [[nodiscard]] double begin() const { return std::min(begin_ + n_done_ * length_, 1.0); }
    [[nodiscard]] double end_of_tasks() const { return std::min(begin() + tasks_ * length_, 1.0); }
    [[nodiscard]] double begin_of_reference() const { return end() - reference_ * length_; }
    [[nodiscard]] double end() const { return std::min(begin_ + (n_done_ + 1) * length_, 1.0); }

    /// The number of the present step, from 1.
    [[nodiscard]] int number() const { return n_done_ + 1; }

    /// Records the times of a step and continues with the next step.
    void end_step(double task_seconds, double measuring_seconds, double reference_seconds)
    {
        ++n_done_;
        const double all = task_seconds + measuring_seconds + reference_seconds;
        if (!(all > 0.0))
            return;
        tasks_ = task_seconds / all;
        reference_ = reference_seconds / all;
    }

  private:
    double begin_;
    double length_;
    double tasks_;
    double reference_;
    int n_done_ = 0;
};

FlowRun::FlowRun(FlowingMesh& mesh, std::unique_ptr<PreparedFlow> prepared, Progress& progress, double setup,
                 FlowReport& report, const FlowControl& control)
    : mesh_(mesh)
    , prepared_(std::move(prepared))
    , progress_(progress)
    , report_(report)
    , setup_(setup)
    , curvature_before_(largest_curvature(prepared_->curvature))
    , extent_before_(box_of_faces(mesh.mesh(), run_in_parallel).diagonal())
    , resume_(control.resume.get())
    , ranks_(control.ranks)
{
    make_steppers();
    constraints_ = std::make_unique<StepConstraints>(mesh.mesh(), prepared_->topology, options());
    free_topology();
    if (resume_ != nullptr)
        restore(*resume_);
    const auto n_taken = static_cast<int>(report.steps.size());
    if (n_taken > 0)
        curvature_before_ = report.steps.back().max_mean_curvature_after;
    fractions_ = std::make_unique<StepFractions>(setup, std::max(options().steps - n_taken, 1), reference_ != nullptr);
    if (constraints_->has_results_apart())
        of_flow_ = stepper_->positions();
}

FlowRun::~FlowRun() = default;

/// Frees those members of the topology that neither steps nor measurements need.
void FlowRun::free_topology()
{
    Topology& topology = prepared_->topology;
    // Mean curvature needs twins, except that of Δ_P.
    if (traits_of(options().laplacian).reach == Reach::TwoRings)
        return;
    topology.twin = std::vector<Index>();
    topology.junctions = std::vector<JunctionLink>();
    // Steps in sub-meshes do not use the topology of the whole mesh.
    const bool is_whole = smooths_normals(options()) || options().scheme == Scheme::ExplicitEuler ||
                          takes_whole_mesh(options().accuracy.approach);
    const bool needs_normals = options().motion.direction.kind != MotionDirection::Kind::Any;
    if (is_whole || options().report.measures || constraints_->limited || needs_normals)
        return;
    topology.vertex_offsets = std::vector<Index>();
    topology.vertex_corners = std::vector<Index>();
}

void FlowRun::make_steppers()
{
    const PolygonMesh& mesh = mesh_.mesh();
    Stopwatch watch;
    if (prepared_->curvature.empty() && options().report.measures)
        curvature_before_ =
            measure_largest_curvature(mesh, prepared_->topology, mesh.vertices, laplacian_of(options()));
    progress_.enter(FlowPhase::Analyse, 0, 0.6 * setup_, options().report.reference ? 0.8 * setup_ : setup_);
    try {
        make_stepper_of_flow();
    } catch (const MemoryLimitError&) {
        if (!prepared_->without_factors)
            throw;
        leave_factors(*prepared_, mesh, progress_.exec());
        make_stepper_of_flow();
    }
    report_to(*prepared_, mesh_, report_);
    report_.cut.labels = std::move(prepared_->cut.labels);
    report_.seconds.analyse = watch.lap();
    report_.seconds.total = report_.seconds.cut + report_.seconds.analyse;
    if (options().report.reference) {
        progress_.enter(FlowPhase::Analyse, 0, 0.8 * setup_, setup_);
        reference_ = make_undecomposed_stepper(mesh, prepared_->topology, options(), std::nullopt, progress_);
    }
}

/// Makes the stepper that the options ask for, or one that shares the steps among ranks.
void FlowRun::make_stepper_of_flow()
{
    const PolygonMesh& mesh = mesh_.mesh();
    if (prepared_->costs && options().accuracy.approach == Approach::ConjugateGradients &&
        filter_of(options()).is_plain())
        stepper_ =
            std::make_unique<SwitchingStepper>(mesh, prepared_->topology, options(), *prepared_->costs, progress_);
    else if (ranks_ != nullptr && !prepared_->stiffness && can_share(*ranks_, prepared_->cut, options()))
        stepper_ = std::make_unique<RankStepper>(*ranks_, mesh, prepared_->topology, prepared_->cut, options(),
                                                 std::move(prepared_->curvature), progress_);
    else
        stepper_ = make_stepper(mesh, prepared_->topology, prepared_->cut, options(), std::move(prepared_->curvature),
                                progress_);
    if (prepared_->stiffness)
        stepper_->give(*prepared_->stiffness);
}

/// Restores everything to its state after a step.
void FlowRun::restore(const FlowState& state)
{
    if (state.cut != checksum_of(report_.cut.labels))
        throw InputError("the state to resume from belongs to another cut of the same mesh: another version of the "
                         "program made it, or one with another METIS");
    require_positions(state.flow, mesh_.mesh());
    if (state.reference)
        require_positions(*state.reference, mesh_.mesh());
    if (state.reference.has_value() != (reference_ != nullptr))
        throw InputError("the state to resume from does not have the undecomposed flow");
    stepper_->restore(state.flow);
    if (reference_)
        reference_->restore(*state.reference);
    Points positions = stepper_->positions();
    constraints_->make_result(positions);
    mesh_.move_to(positions);
    if (prepared_->meter)
        prepared_->meter->restore(state.displacement, mesh_.mesh().vertices);
    report_.steps = state.steps;
    report_.seconds.step = state.seconds.step;
    report_.seconds.total += state.seconds.total;
}

void FlowRun::diffuse(Points& data, int n, DataSteps steps)
{
    mesh_.join(data);
    stepper_->set_data(data, steps);
    for (int step = 1; step <= n; ++step) {
        progress_.enter(FlowPhase::Step, fractions_->number(), fractions_->begin(), fractions_->end());
        Stopwatch watch;
        named("step " + std::to_string(step), [&] { stepper_->step(data); });
        copy(progress_.exec(), stepper_->positions(), data);
        report_.seconds.step += watch.seconds();
        report_.seconds.total += watch.seconds();
        fractions_->end_step(watch.seconds(), 0.0, 0.0);
    }
    mesh_.take_along(data);
}

bool FlowRun::diffuse_further(Eigen::Ref<Eigen::MatrixXd> fields, int n)
{
    // The columns of a call: few, so that progress is reported between calls.
    constexpr Eigen::Index at_once = 192;
    if (!stepper_->can_take_columns())
        return false;
    for (Eigen::Index first = 0; first < fields.cols(); first += at_once) {
        auto portion = fields.middleCols(first, std::min(at_once, fields.cols() - first));
        progress_.enter(FlowPhase::Step, fractions_->number(), fractions_->begin(), fractions_->end());
        Stopwatch watch;
        mesh_.join(portion);
        stepper_->take_steps(portion, n, progress_.exec());
        mesh_.take_along(portion);
        report_.seconds.step += watch.seconds();
        report_.seconds.total += watch.seconds();
        for (Eigen::Index step = 0; step < n * ((portion.cols() + 2) / 3); ++step)
            fractions_->end_step(watch.seconds(), 0.0, 0.0);
    }
    return true;
}

FlowState FlowRun::capture() const
{
    if (was_changed_)
        throw ComputationError("a flow that was changed between its steps has no state to resume from");
    FlowState state{.identity = prepared_->identity,
                    .approach = options().accuracy.approach,
                    .cut = checksum_of(report_.cut.labels),
                    .steps = report_.steps,
                    .seconds = {.step = report_.seconds.step,
                                .total = report_.seconds.total - report_.seconds.cut - report_.seconds.analyse},
                    .displacement = prepared_->meter ? prepared_->meter->sums() : DisplacementSums{}};
    if (resume_ != nullptr)
        state.seconds.add_tasks(resume_->seconds);
    stepper_->add_seconds(state.seconds);
    stepper_->save(state.flow);
    if (reference_)
        reference_->save(state.reference.emplace());
    return state;
}

void FlowRun::compare_with_reference(int step, StepReport& of_step)
{
    progress_.enter(FlowPhase::Reference, step, fractions_->begin_of_reference(), fractions_->end());
    Stopwatch watch;
    const Points before = reference_->positions();
    named("step " + std::to_string(step) + " of the undecomposed flow", [&] {
        constraints_->vanishing.step(*reference_, before);
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
}

/// Notifies the observer, with all positions at the location of the given mesh.
void FlowRun::notify_observer(const StepObserver& on_step, int step, const StepReport& of_step,
                              const Points* undecomposed) const
{
    const PolygonMesh* separated = stepper_->separated();
    std::optional<Points> undecomposed_there;
    std::optional<PolygonMesh> separated_there;
    if (mesh_.is_elsewhere() && undecomposed != nullptr) {
        mesh_.bring_back(undecomposed_there.emplace(*undecomposed));
        undecomposed = &*undecomposed_there;
    }
    if (mesh_.is_elsewhere() && separated != nullptr) {
        mesh_.bring_back(separated_there.emplace(*separated));
        separated = &*separated_there;
    }
    on_step({step, mesh_.given().vertices, of_step, separated, undecomposed, [&] { return capture(); }});
}

void FlowRun::measure(const Points& after, StepReport& of_step)
{
    if (!prepared_->meter)
        return;
    of_step.displacement = prepared_->meter->add_step(mesh_.mesh().vertices, after);
    of_step.max_mean_curvature_before = curvature_before_;
    of_step.max_mean_curvature_after = curvature_before_ =
        measure_largest_curvature(mesh_.mesh(), prepared_->topology, after, laplacian_of(options()));
}

void FlowRun::take_step(const StepObserver& on_step)
{
    const PolygonMesh& mesh = mesh_.mesh();
    const bool is_apart = constraints_->has_results_apart();
    const Points& before = is_apart ? of_flow_ : mesh.vertices;
    const int step = static_cast<int>(report_.steps.size()) + 1;
    const std::string name = "step " + std::to_string(step);
    progress_.enter(FlowPhase::Step, step, fractions_->begin(), fractions_->end_of_tasks());
    Stopwatch watch;
    named(name, [&] {
        constraints_->vanishing.step(*stepper_, before);
        constraints_->direct(*stepper_, before);
    });
    StepReport of_step;
    of_step.seconds = watch.lap();
    stepper_->report_to(of_step);
    in_mean_edges(of_step.estimated_v_max, mesh, stepper_->positions());
    // Checked before scaling, which could hide that a vertex was thrown away, or shrink the rest too much.
    named(name, [&] {
        constraints_->limit->require(before, stepper_->positions(), report_.cut.labels);
        constraints_->rescale(*stepper_);
        if (is_apart) {
            of_flow_ = result_ = stepper_->positions();
            constraints_->make_result(result_);
        }
    });
    const Points& after = is_apart ? result_ : stepper_->positions();
    double measuring = watch.lap();
    if (reference_) {
        compare_with_reference(step, of_step);
        undecomposed_ = reference_->positions();
        named(name + " of the undecomposed flow", [&] { constraints_->make_result(undecomposed_); });
    }
    // Measurements are sums over steps: only complete steps are added.
    watch.lap();
    measure(after, of_step);
    measuring += watch.lap();
    fractions_->end_step(of_step.seconds, measuring, of_step.reference_seconds.value_or(0.0));

    // Memory is allocated first: the mesh moves only after everything except the observer has succeeded.
    report_.steps.push_back(of_step);
    report_.seconds.step += of_step.seconds;
    report_.seconds.total += of_step.seconds + measuring;
    mesh_.move_to(after);
    if (on_step)
        notify_observer(on_step, step, of_step, reference_ ? &undecomposed_ : nullptr);
}

void FlowRun::complete(FlowReport& report) const
{
    // These remarks concern positions, which flows of fields do not move.
    if (!report_.steps.empty())
        std::ranges::copy(constraints_->remarks(), std::back_inserter(report.remarks));
    remark_on_drift(options(), report);
    remark_on_collapse(extent_before_, box_of_faces(mesh_.mesh(), run_in_parallel).diagonal(), report);
    if (prepared_->meter)
        report.displacement = prepared_->meter->total();
    if (stepper_->separated() != nullptr)
        report.separated = *stepper_->separated();
    stepper_->report_to(report);
    remark_on_factorisation(options().resources.factorisation, report);
    remark_on_near_singularity(report);
    if (resume_ != nullptr)
        report.seconds.add_tasks(resume_->seconds);
    mesh_.complete(report);
}

}  // namespace seamflow
