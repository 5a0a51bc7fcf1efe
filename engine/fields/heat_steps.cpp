#include "engine/fields/heat_steps.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/flow_remarks.h"
#include "engine/steppers/conjugate_gradient_stepper.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/tasks/named.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "solvers/laplacian/delaunay_stiffness.h"

namespace seamflow {

namespace {

/// The number of columns that steppers take at a time: as many as positions have.
constexpr Eigen::Index columns_of_block = 3;
/// The largest number of columns of a call for many columns: small, so that progress is reported between calls.
constexpr Eigen::Index columns_at_once = 192;
/// The parts that HeatSteps::make_surface_and_plan counts as done: the surface is checked; it is made, with its
/// vertices that move; and the approach is chosen, which `decide` counts.
constexpr double parts_of_surface_and_plan = 3.0;

}  // namespace

HeatSteps::HeatSteps(PolygonMesh& surface, const FlowOptions& options, Weights weights, const FlowControl& control,
                     Progress& progress, FlowReport& report)
    : options_(options)
    , weights_(weights)
    , ranks_(control.ranks)
    , progress_(progress)
    , report_(report)
{
    Stopwatch watch;
    const double setup = fraction_of_setup(options);
    progress.set_steps(options.steps);
    progress.enter(FlowPhase::Cut, 0, 0.0, begin_of_steppers * setup);
    progress.expect(parts_of_surface_and_plan);
    make_surface_and_plan(surface);
    report.seconds.cut = watch.lap();
    progress.enter(FlowPhase::Analyse, 0, begin_of_steppers * setup, setup);
    make_stepper_within_limit();
    report_to(plan_, *surface_, options_, {}, report);
    report.cut.labels = std::move(plan_.cut.labels);
    free_topology();
    report.seconds.analyse = watch.lap();
    report.seconds.total = report.seconds.cut + report.seconds.analyse;
    constexpr bool with_reference = false;
    fractions_.emplace(setup, std::max(options.steps, 1), with_reference);
}

/// Replaces the faces by those of an intrinsic Delaunay triangulation of the same surface, if the options ask for
/// weights of at least 0 and the Laplacian has others. Keeps K and M of the triangulation in stiffness_.
/// @returns whether the faces were replaced.
bool HeatSteps::flip_edges(Surface& surface)
{
    if (weights_ == Weights::OfLaplacian)
        return false;
    std::optional<DelaunaySurface> flipped = make_delaunay(surface.mesh.mesh(), surface.topology, options_.laplacian,
                                                           weights_ == Weights::AtLeastZeroInFaces, progress_.exec());
    if (!flipped)
        return false;
    surface.mesh.replace_faces(std::move(flipped->mesh), flipped->face_of);
    stiffness_ = std::move(flipped->stiffness);
    // Only plain steps keep values in their range: other filters can leave it with any weights.
    surface.choices.push_back(
        {"flipped edges",
         {},
         {fmt::format("Edges opposite to obtuse angles are flipped within the surface, so that {}.",
                      filter_of(options_).is_plain() ? "values stay in their range" : "no weight is below 0")}});
    return true;
}

/// Decides which vertices have equations, and how these are solved.
void HeatSteps::make_surface_and_plan(PolygonMesh& given)
{
    FlowingMesh mesh(given);
    require_valid(mesh.mesh(), progress_.exec());
    progress_.count();
    auto [surface, motion] = make_surface(
        std::move(mesh), std::move(options_.motion),
        {.laplacian = options_.laplacian, .replace_faces = [this](Surface& made) { return flip_edges(made); }},
        progress_);
    options_.motion = std::move(motion);
    options_.cut.labels = surface.mesh.of_faces_left(options_.cut.labels);
    surface_.emplace(std::move(surface));
    progress_.count();
    plan_ = decide(*surface_, options_, std::nullopt, ranks_ != nullptr ? Sharing::Ranks : Sharing::None, progress_,
                   [](Approach) {});
}

/// Makes the stepper; if its factorisations exceed the memory limit, one without them, if the plan has such an
/// alternative.
void HeatSteps::make_stepper_within_limit()
{
    try {
        make_stepper();
    } catch (const MemoryLimitError&) {
        if (!plan_.without_factors)
            throw;
        leave_factors(plan_, surface_->mesh.mesh(), surface_->topology, progress_.exec());
        make_stepper();
    }
}

/// Makes the stepper of the plan: shared by ranks, by conjugate gradients, or in sub-meshes.
void HeatSteps::make_stepper()
{
    const PolygonMesh& mesh = surface_->mesh.mesh();
    const GivenStiffness* const given = stiffness_ ? &*stiffness_ : nullptr;
    const StepSettings settings = settings_of(options_, plan_.way, mesh.vertices);
    if (ranks_ != nullptr && given == nullptr && ranks_->can_share(plan_, settings)) {
        stepper_ = ranks_->make_stepper(mesh, surface_->topology, plan_, settings, {}, progress_);
    } else if (const auto* const gradients = std::get_if<GradientSteps>(&plan_.way)) {
        stepper_ = std::make_unique<ConjugateGradientStepper>(mesh, surface_->topology, settings, gradients->stop,
                                                              progress_, given);
    } else {
        const auto* const converged = std::get_if<ConvergedSteps>(&plan_.way);
        auto stepper = std::make_unique<SchurStepper>(
            mesh, surface_->topology, plan_.cut, settings,
            converged != nullptr ? converged->stop : std::get<UndecomposedSteps>(plan_.way).stop(), progress_, given);
        in_sub_meshes_ = stepper.get();
        stepper_ = std::move(stepper);
    }
}

/// Frees the topology. Conjugate gradients keep it, except twins and junctions, which they do not need.
void HeatSteps::free_topology()
{
    if (!std::holds_alternative<GradientSteps>(plan_.way))
        surface_->topology = {};
    surface_->topology.twin = std::vector<Index>();
    surface_->topology.junctions = std::vector<JunctionLink>();
}

void HeatSteps::take(Eigen::Ref<Eigen::MatrixXd> fields, int n)
{
    for (Eigen::Index c = 0; c < fields.cols(); c += columns_of_block) {
        const Eigen::Index n_columns = std::min(columns_of_block, fields.cols() - c);
        Points block = Points::Zero(fields.rows(), columns_of_block);
        block.leftCols(n_columns) = fields.middleCols(c, n_columns);
        take_block(block, n, c == 0 ? DataSteps::Further : DataSteps::Again);
        fields.middleCols(c, n_columns) = block.leftCols(n_columns);
        // The first columns have made the factor that the others need.
        if (c == 0 && in_sub_meshes_ != nullptr && in_sub_meshes_->can_take_columns())
            return take_at_once(fields.rightCols(fields.cols() - n_columns), n);
    }
}

/// Takes n steps with three columns, as if they were positions.
/// @param block #V by 3, in the order of the given surface. @param steps how the steps are counted (see DataSteps).
void HeatSteps::take_block(Points& block, int n, DataSteps steps)
{
    surface_->mesh.join(block);
    stepper_->set_data(block, steps);
    for (int step = 1; step <= n; ++step) {
        const Stopwatch watch = begin_step();
        named("step " + std::to_string(step), [&] { stepper_->step(block); });
        copy(progress_.exec(), stepper_->positions(), block);
        end_steps(watch, 1);
    }
    surface_->mesh.take_along(block);
}

/// Takes the steps of further columns, many at a time, with the factor that earlier steps have made.
void HeatSteps::take_at_once(Eigen::Ref<Eigen::MatrixXd> fields, int n)
{
    for (Eigen::Index first = 0; first < fields.cols(); first += columns_at_once) {
        auto portion = fields.middleCols(first, std::min(columns_at_once, fields.cols() - first));
        const Stopwatch watch = begin_step();
        // Vertices that are joined along seams get the mean of their values, and all of them the result.
        surface_->mesh.join(portion);
        in_sub_meshes_->take_columns(portion, n, progress_.exec());
        surface_->mesh.take_along(portion);
        end_steps(watch, n * ((portion.cols() + columns_of_block - 1) / columns_of_block));
    }
}

/// Reports the beginning of a step to the observer. @returns a stopwatch for it.
Stopwatch HeatSteps::begin_step()
{
    progress_.enter(FlowPhase::Step, fractions_->number(), fractions_->begin(), fractions_->end());
    return {};
}

/// Adds the time of steps to the report and to the progress.
/// @param watch begun before the steps. @param n the number of steps, each of a block of columns.
void HeatSteps::end_steps(const Stopwatch& watch, Eigen::Index n)
{
    report_.seconds.step += watch.seconds();
    report_.seconds.total += watch.seconds();
    for (Eigen::Index step = 0; step < n; ++step)
        fractions_->end_step(watch.seconds(), 0.0, 0.0);
}

void HeatSteps::weigh(const std::function<double(Index v, Index w)>& squared_difference)
{
    if (in_sub_meshes_ == nullptr)
        throw OptionError("edges of fields are kept only in converged and undecomposed steps: leave the approach "
                          "automatic");
    in_sub_meshes_->weigh(squared_difference);
}

void HeatSteps::complete(FlowReport& report) const
{
    stepper_->report_to(report);
    remark_on_factorisation(options_.resources.factorisation, report);
    surface_->mesh.complete(report);
    report.cut.labels = surface_->mesh.labels_of_given(std::move(report.cut.labels), report.cut.n_sub_meshes());
}

}  // namespace seamflow
