#include "engine/motion/surface_run.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/measure/surface_measures.h"
#include "engine/tasks/named.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "partition/metrics/bounding_box.h"

namespace seamflow {

SurfaceRun::SurfaceRun(Surface& surface, Progress& progress, RunReport& report, const FlowState* resume)
    : mesh_(surface.mesh)
    , topology_(surface.topology)
    , progress_(progress)
    , report_(report)
    , resume_(resume)
    , laplacian_(Laplacian::Fujiwara)
    , extent_before_(box_of_faces(surface.mesh.mesh(), run_in_parallel).diagonal())
{
}

void SurfaceRun::measure_by(DisplacementMeter meter, const ScaledLaplacian& laplacian, double curvature)
{
    meter_.emplace(std::move(meter));
    laplacian_ = laplacian;
    curvature_before_ = curvature;
}

void SurfaceRun::begin(const MotionOptions& motion, bool continues_scaled, double largest_update, double setup,
                       int steps, bool compares)
{
    constraints_.emplace(mesh_.mesh(), topology_, motion, continues_scaled, largest_update);
    if (resume_ != nullptr)
        restore(*resume_);
    const auto n_taken = static_cast<int>(report_.steps.size());
    if (n_taken > 0)
        curvature_before_ = report_.steps.back().max_mean_curvature_after;
    fractions_.emplace(setup, std::max(steps - n_taken, 1), compares);
    if (constraints_->has_results_apart())
        of_run_ = stepper().positions();
}

void SurfaceRun::require_positions(const StepMemory& memory) const
{
    if (memory.positions.rows() != mesh_.mesh().vertices.rows())
        throw InputError("the state to resume from does not have the vertices of this mesh");
    if (!memory.positions.allFinite())
        throw InputError("the state to resume from has positions that are not finite: it has been changed");
}

FlowState SurfaceRun::capture() const
{
    // Without the time for the cut and the analysis: a run that resumes does both again, and its total begins with
    // them.
    FlowState state{.steps = report_.steps,
                    .seconds = {.step = report_.seconds.step,
                                .total = report_.seconds.total - report_.seconds.cut - report_.seconds.analyse},
                    .displacement = meter_ ? meter_->sums() : DisplacementSums{}};
    stepper().save(state.flow);
    return state;
}

void SurfaceRun::restore(const FlowState& state)
{
    require_positions(state.flow);
    stepper().restore(state.flow);
    Points positions = stepper().positions();
    constraints_->make_result(stepper(), positions);
    mesh_.move_to(positions);
    if (meter_)
        meter_->restore(state.displacement, mesh_.mesh().vertices);
    report_.steps = state.steps;
    report_.seconds.step = state.seconds.step;
    report_.seconds.total += state.seconds.total;
}

void SurfaceRun::measure(const Points& after, StepReport& of_step)
{
    if (!meter_)
        return;
    of_step.displacement = meter_->add_step(mesh_.mesh().vertices, after);
    of_step.max_mean_curvature_before = curvature_before_;
    of_step.max_mean_curvature_after = curvature_before_ =
        measure_largest_curvature(mesh_.mesh(), topology_, after, laplacian_);
}

void SurfaceRun::take_step(const StepObserver& on_step)
{
    const bool is_apart = constraints_->has_results_apart();
    const Points& before = is_apart ? of_run_ : mesh_.mesh().vertices;
    const int step = static_cast<int>(report_.steps.size()) + 1;
    const std::string name = "step " + std::to_string(step);
    progress_.enter(FlowPhase::Step, step, fractions_->begin(), fractions_->end_of_tasks());
    Stopwatch watch;
    named(name, [&] {
        move(before);
        constraints_->direct(stepper(), before);
    });
    StepReport of_step;
    of_step.seconds = watch.lap();
    describe(of_step);
    // Checked before scaling, which could hide that a vertex was thrown away, or shrink the rest too much.
    named(name, [&] {
        constraints_->limit->require(before, stepper().positions(), labels());
        constraints_->rescale(stepper());
        if (is_apart) {
            of_run_ = result_ = stepper().positions();
            constraints_->make_result(stepper(), result_);
        }
    });
    const Points& after = is_apart ? result_ : stepper().positions();
    double measuring = watch.lap();
    compare(step, of_step);
    // The time of the comparison does not count.
    watch.lap();
    // Measurements are sums over steps: only complete steps are added.
    measure(after, of_step);
    measuring += watch.lap();
    fractions_->end_step(of_step.seconds, measuring, of_step.reference_seconds.value_or(0.0));

    // Memory is allocated first: the mesh moves only after everything except the observer has succeeded.
    report_.steps.push_back(of_step);
    report_.seconds.step += of_step.seconds;
    report_.seconds.total += of_step.seconds + measuring;
    mesh_.move_to(after);
    if (on_step)
        show({.step = step,
              .positions = mesh_.given().vertices,
              .report = of_step,
              .capture = [&] { return std::make_shared<const FlowState>(capture()); }},
             on_step);
}

void SurfaceRun::remark_on_constraints(RunReport& report, const std::optional<Remark>& on_components) const
{
    // These remarks concern positions, which runs without steps, and those of fields, do not move.
    if (report_.steps.empty())
        return;
    for (const auto& remark :
         {constraints_->limited ? constraints_->limited->remark() : on_components, constraints_->rescaling.remark()})
        if (remark)
            report.remarks.push_back(*remark);
}

void SurfaceRun::report_measures(RunReport& report) const
{
    remark_on_collapse(extent_before_, box_of_faces(mesh_.mesh(), run_in_parallel).diagonal(), report);
    if (meter_)
        report.displacement = meter_->total();
}

}  // namespace seamflow
