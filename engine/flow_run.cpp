#include "engine/flow_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/component_limits.h"
#include "engine/measure/displacement_bound.h"
#include "engine/measure/remarks.h"
#include "engine/measure/rescaling.h"
#include "engine/measure/surface_measures.h"
#include "engine/measure/update_limit.h"
#include "engine/steppers/directed_motion.h"
#include "engine/steppers/make_stepper.h"
#include "engine/steppers/switching_stepper.h"
#include "engine/steppers/vanishing_components.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
#include "partition/metrics/surface_distance.h"
#include "solvers/laplacian/degenerate.h"

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

/// Approximately that of all faces: good enough for an estimate.
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

/// @param estimate in units of length; emptied if the edges have no length to measure by.
void in_mean_edges(std::optional<double>& estimate, const PolygonMesh& mesh, const Points& positions)
{
    if (!estimate || *estimate == 0.0)
        return;
    *estimate /= sampled_mean_edge(mesh, positions);
    if (!std::isfinite(*estimate))
        estimate.reset();
}

/// Whether a step begins with the rescaled result of the previous one, not with that itself. The weights of the
/// conformalized flow do not depend on the size of the surface: it becomes a sphere instead of vanishing.
bool goes_on_scaled(const FlowOptions& options)
{
    return options.motion.rescale != Rescale::None && options.flow == FlowEquation::Conformalized;
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

/// Where the parts of the steps begin and end within a whole flow, which ends with the steps that were expected,
/// however many follow. All steps take equally long; a step is divided as the time of the previous one was.
class FlowRun::StepFractions {
  public:
    /// @param begin the fraction of the whole that is done before the first step.
    /// @param steps the number of steps.
    StepFractions(double begin, int steps, bool with_reference)
        : begin_(begin)
        , length_((1.0 - begin) / steps)
        , tasks_(with_reference ? 0.3 : 0.9)
        , reference_(with_reference ? 0.6 : 0.0)
    {
    }

    /// Fractions of the whole: the beginning of the step, the end of its tasks, the beginning of its reference step,
    /// and its end.
    [[nodiscard]] double begin() const { return std::min(begin_ + n_done_ * length_, 1.0); }
    [[nodiscard]] double end_of_tasks() const { return std::min(begin() + tasks_ * length_, 1.0); }
    [[nodiscard]] double begin_of_reference() const { return end() - reference_ * length_; }
    [[nodiscard]] double end() const { return std::min(begin_ + (n_done_ + 1) * length_, 1.0); }

    /// That of the step, from 1.
    [[nodiscard]] int number() const { return n_done_ + 1; }

    /// Continues with the next step.
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

/// The tools that take and check steps, and make results from their positions.
struct FlowRun::StepTools {
    StepTools(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options)
        : is_scaled(goes_on_scaled(options))
        , is_scaled_apart(options.motion.rescale != Rescale::None && !is_scaled)
        , rescaling(mesh, topology, options.motion.rescale)
        , vanishing(options, mesh.vertices, find_small_components(mesh, topology, options.motion.strength))
        , mesh_(&mesh)
    {
        if (options.motion.direction.kind != MotionDirection::Kind::Any)
            directed_.emplace(mesh, topology, options.motion.direction);
        limit.emplace(mesh, options.accuracy.largest_update);
        if (options.motion.limits.exist())
            limited.emplace(mesh, topology, options.motion.limits);
        if (options.motion.within)
            bound.emplace(mesh, topology, *options.motion.within);
    }

    /// Whether results differ from the positions that the flow continues from.
    [[nodiscard]] bool has_results_apart() const { return is_scaled_apart || bound || limited; }

    /// Makes a result of positions of the flow.
    void make_result(Points& positions)
    {
        if (is_scaled_apart)
            rescaling.apply(positions);
        if (bound)
            bound->apply(positions);
        if (limited)
            limited->apply(positions);
        if (directed_ && directed_->is_parallel() && has_results_apart())
            directed_->project(mesh_->vertices, positions, run_in_parallel);
    }

    /// Leaves of a step only the motion along the lines that the options ask for.
    /// @param before #V by 3: where the step began.
    void direct(Stepper& stepper, const Points& before) const
    {
        if (!directed_)
            return;
        Points directed = stepper.positions();
        directed_->project(before, directed, run_in_parallel);
        stepper.continue_from(directed, {});
    }

    /// Rescales the surface that the next step begins with, where steps begin with results.
    void rescale(Stepper& stepper) const
    {
        if (!is_scaled)
            return;
        Points rescaled = stepper.positions();
        const Similarity similarity = rescaling.apply(rescaled);
        stepper.continue_from(rescaled, similarity);
    }

    /// Limits have their own remark on components that lose too much.
    [[nodiscard]] std::string remark() const { return limited ? limited->remark() : vanishing.remark(); }

    bool is_scaled;
    bool is_scaled_apart;
    Rescaling rescaling;
    std::optional<LimitedComponents> limited;
    std::optional<DisplacementBound> bound;

    VanishingComponents vanishing;
    std::optional<UpdateLimit> limit;

  private:
    const PolygonMesh* mesh_;
    std::optional<DirectedMotion> directed_;
};

FlowRun::FlowRun(FlowingMesh& mesh, std::unique_ptr<PreparedFlow> prepared, Progress& progress, double setup,
                 FlowReport& report, const FlowState* resume)
    : mesh_(mesh)
    , prepared_(std::move(prepared))
    , progress_(progress)
    , report_(report)
    , setup_(setup)
    , curvature_before_(largest_curvature(prepared_->curvature))
    , extent_before_(extent_of(mesh.mesh().vertices))
    , resume_(resume)
{
    make_steppers();
    tools_ = std::make_unique<StepTools>(mesh.mesh(), prepared_->topology, options());
    free_topology();
    if (resume != nullptr)
        restore(*resume);
    const auto n_taken = static_cast<int>(report.steps.size());
    if (n_taken > 0)
        curvature_before_ = report.steps.back().max_mean_curvature_after;
    fractions_ = std::make_unique<StepFractions>(setup, std::max(options().steps - n_taken, 1), reference_ != nullptr);
    if (tools_->has_results_apart())
        of_flow_ = stepper_->positions();
}

FlowRun::~FlowRun() = default;

/// Frees what steps and measures do not need.
void FlowRun::free_topology()
{
    Topology& topology = prepared_->topology;
    // Mean curvature is measured across edges, except for that of Δ_P.
    if (traits_of(options().laplacian).reach == Reach::TwoRings)
        return;
    topology.twin = std::vector<Index>();
    topology.junctions = std::vector<JunctionLink>();
    // Steps of sub-meshes do not use the whole mesh.
    const bool is_whole = options().keep_edges || options().scheme == Scheme::ExplicitEuler ||
                          takes_whole_mesh(options().accuracy.approach);
    const bool needs_normals = options().motion.direction.kind == MotionDirection::Kind::Normal;
    if (is_whole || options().report.measures || tools_->limited || needs_normals)
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
    describe(*prepared_, mesh_, report_);
    progress_.enter(FlowPhase::Analyse, 0, 0.6 * setup_, options().report.reference ? 0.8 * setup_ : setup_);
    if (prepared_->costs && options().accuracy.approach == Approach::ConjugateGradients &&
        filter_of(options()).is_plain())
        stepper_ =
            std::make_unique<SwitchingStepper>(mesh, prepared_->topology, options(), *prepared_->costs, progress_);
    else
        stepper_ = make_stepper(mesh, prepared_->topology, prepared_->cut, options(), std::move(prepared_->curvature),
                                progress_);
    report_.cut.labels = std::move(prepared_->cut.labels);
    report_.seconds.analyse = watch.lap();
    report_.seconds.total = report_.seconds.cut + report_.seconds.analyse;
    if (options().report.reference) {
        progress_.enter(FlowPhase::Analyse, 0, 0.8 * setup_, setup_);
        reference_ = make_undecomposed_stepper(mesh, prepared_->topology, options(), progress_);
    }
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
    tools_->make_result(positions);
    mesh_.move_to(positions);
    if (prepared_->meter)
        prepared_->meter->restore(state.displacement, mesh_.mesh().vertices);
    report_.steps = state.steps;
    report_.seconds.step = state.seconds.step;
    report_.seconds.total += state.seconds.total;
}

/// @returns the vertices of the flowing mesh that these move with.
std::vector<Index> FlowRun::require_changeable(std::string_view what, std::span<const Index> vertices,
                                               bool needs_stepper) const
{
    if (reference_ || tools_->has_results_apart() || tools_->is_scaled)
        throw OptionError(fmt::format("a flow with a reference, rescale, within or limits does not {} vertices between "
                                      "steps: begin a new flow",
                                      what));
    if (needs_stepper && !stepper_->can_change())
        throw OptionError(fmt::format("this flow does not {} vertices between steps: only converged steps of symmetric "
                                      "Laplacians do; begin a new flow",
                                      what));
    std::vector<Index> flowing;
    for (const Index v : vertices) {
        if (v < 0 || v >= mesh_.mesh().n_vertices())
            throw InputError(
                fmt::format("vertex {} is to {} between steps, but the mesh has {} vertices, numbered from 0", v, what,
                            mesh_.mesh().n_vertices()));
        flowing.push_back(mesh_.moves_with(v));
    }
    return flowing;
}

void FlowRun::hold(std::span<const Index> vertices, bool is_held)
{
    std::vector<Index> flowing = require_changeable(is_held ? "hold" : "release", vertices, true);
    Topology& topology = prepared_->topology;
    is_held_.resize(topology.fixed.size(), 0);
    for (const Index v : flowing)
        if (!is_held && !topology.moves(v) && is_held_[v] == 0)
            throw OptionError(fmt::format("vertex {} was fixed when the flow began: only vertices held since then can "
                                          "be released; begin a new flow",
                                          v));
    std::erase_if(flowing, [&](Index v) { return topology.moves(v) != is_held; });
    stepper_->hold(flowing, is_held);
    for (const Index v : flowing)
        topology.fixed[v] = is_held_[v] = is_held ? 1 : 0;
    tools_->vanishing.look_again(find_small_components(mesh_.mesh(), topology, options().motion.strength));
    was_changed_ = true;
}

void FlowRun::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    const std::vector<Index> flowing = require_changeable("attach", vertices, true);
    if (!attaches(options().motion))
        throw OptionError("only a flow with an attachment has weights to change between steps: set attachment or "
                          "attachment_weights");
    if (weights.size() != vertices.size())
        throw OptionError(
            fmt::format("{} vertices have {} attachment weights: give one for each", vertices.size(), weights.size()));
    for (const double weight : weights)
        if (!(weight >= 0.0 && std::isfinite(weight)))
            throw OptionError(
                fmt::format("an attachment weight is {}, but must be at least 0 and finite (1/length²)", weight));
    stepper_->attach(flowing, weights);
    tools_->vanishing.attach(flowing, weights);
    was_changed_ = true;
}

void FlowRun::move(std::span<const Index> vertices, const Points& to)
{
    const std::vector<Index> flowing =
        require_changeable("move", vertices, options().flow != FlowEquation::MeanCurvature);
    if (to.rows() != std::ssize(vertices) || !to.allFinite())
        throw OptionError(fmt::format("{} vertices are to move to {} positions: give a finite one for each",
                                      vertices.size(), to.rows()));
    const Points there = mesh_.to_flowing(to);
    require_rows(flowing, there);
    mesh_.move_isolated(vertices, to);
    stepper_->move(flowing, there);
    stepper_->move_first(flowing, there);
    tools_->vanishing.move_first(flowing, there);
    mesh_.move_to(stepper_->positions());
    tools_->limit.emplace(mesh_.mesh(), options().accuracy.largest_update);
    was_changed_ = true;
}

/// @throws InputError if vertices would move to where no step is defined for them.
void FlowRun::require_rows(std::span<const Index> vertices, const Points& to) const
{
    PolygonMesh moved = mesh_.mesh();
    move_rows(vertices, to, moved.vertices);
    const std::vector<Index> undefined =
        vertices_without_row(moved, prepared_->topology, options().laplacian, progress_.exec());
    for (const Index v : vertices)
        if (std::ranges::binary_search(undefined, v))
            throw InputError(
                fmt::format("vertex {} would lie at the same place as one beside it, or have a face without "
                            "area: move it elsewhere",
                            v));
}

void FlowRun::diffuse(Points& data, int n)
{
    mesh_.join(data);
    stepper_->begin(data);
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

void FlowRun::weigh(const std::function<double(Index v, Index w)>& squared_difference)
{
    if (!stepper_->can_change())
        throw OptionError("edges of fields are kept only in converged and undecomposed steps: leave the approach "
                          "automatic");
    stepper_->weigh(squared_difference);
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
        tools_->vanishing.step(*reference_, before);
        tools_->direct(*reference_, before);
        tools_->rescale(*reference_);
    });
    of_step.reference_seconds = watch.lap();
    PolygonMesh undecomposed = mesh_.mesh();
    undecomposed.vertices = reference_->positions();
    PolygonMesh decomposed = mesh_.mesh();
    decomposed.vertices = stepper_->positions();
    mesh_.take_along(undecomposed.vertices);
    mesh_.take_along(decomposed.vertices);
    of_step.distance = vertex_distance(undecomposed, undecomposed.vertices, decomposed.vertices);
    of_step.surface_distance = surface_distance(undecomposed, decomposed);
}

/// An observer sees everything where the given mesh lies.
void FlowRun::tell(const StepObserver& on_step, int step, const StepReport& of_step, const Points* undecomposed) const
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
    on_step({step, mesh_.given_positions(), of_step, separated, undecomposed, [&] { return capture(); }});
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
    const bool is_apart = tools_->has_results_apart();
    const Points& before = is_apart ? of_flow_ : mesh.vertices;
    const int step = static_cast<int>(report_.steps.size()) + 1;
    const std::string name = "step " + std::to_string(step);
    progress_.enter(FlowPhase::Step, step, fractions_->begin(), fractions_->end_of_tasks());
    Stopwatch watch;
    named(name, [&] {
        tools_->vanishing.step(*stepper_, before);
        tools_->direct(*stepper_, before);
    });
    StepReport of_step;
    of_step.seconds = watch.lap();
    stepper_->describe(of_step);
    in_mean_edges(of_step.estimated_v_max, mesh, stepper_->positions());
    // Scaling could hide that vertices have been thrown away, or shrink what is left too much.
    named(name, [&] {
        tools_->limit->require(before, stepper_->positions(), report_.cut.labels);
        tools_->rescale(*stepper_);
        if (is_apart) {
            of_flow_ = result_ = stepper_->positions();
            tools_->make_result(result_);
        }
    });
    const Points& after = is_apart ? result_ : stepper_->positions();
    double measuring = watch.lap();
    if (reference_) {
        compare_with_reference(step, of_step);
        undecomposed_ = reference_->positions();
        named(name + " of the undecomposed flow", [&] { tools_->make_result(undecomposed_); });
    }
    // What is measured adds up: only of complete steps.
    watch.lap();
    measure(after, of_step);
    measuring += watch.lap();
    fractions_->end_step(of_step.seconds, measuring, of_step.reference_seconds.value_or(0.0));

    // Memory is allocated first: the mesh moves only when nothing but the observer can still fail.
    report_.steps.push_back(of_step);
    report_.seconds.step += of_step.seconds;
    report_.seconds.total += of_step.seconds + measuring;
    mesh_.move_to(after);
    if (on_step)
        tell(on_step, step, of_step, reference_ ? &undecomposed_ : nullptr);
}

void FlowRun::complete(FlowReport& report) const
{
    // It is about positions, which flows of fields do not move.
    if (const std::string remark = tools_->remark(); !remark.empty() && !report_.steps.empty())
        report.remarks.push_back(remark);
    remark_on_drift(options(), report);
    remark_on_collapse(extent_before_, mesh_.mesh().vertices, report);
    if (prepared_->meter)
        report.displacement = prepared_->meter->total();
    if (stepper_->separated() != nullptr)
        report.separated = *stepper_->separated();
    stepper_->describe(report);
    if (resume_ != nullptr)
        report.seconds.add_tasks(resume_->seconds);
    mesh_.complete(report);
}

}  // namespace seamflow
