#include "engine/steppers/converged_stepper.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/measure/flow_remarks.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"

namespace seamflow {

ConvergedStepper::ConvergedStepper(const PolygonMesh& mesh, Index n_sub_meshes, const StepSettings& settings,
                                   const IterationStop& stop, double parts_of_equation, Progress& progress)
    : time_step_(settings.equation.time_step)
    , filter_(settings.equation.filter)
    , seconds_(usize(n_sub_meshes) + 1)
    , graph_(&progress, settings.records_schedule)
    , root_(graph_.add_root())
    , equation_solved_(graph_.add_task([this] { solve(); }, {TaskKind::SolveInterface, -1}))
    , stop_(stop)
    , loops_(parts_of_equation, progress)
{
    copy(run_in_parallel, mesh.vertices, positions_);
    graph_.add_dependency(root_, equation_solved_);
}

void ConvergedStepper::step(const Points& before)
{
    assert(&before != &positions_);
    before_ = &before;
    graph_.run(0, loops_.parts());
    if (!filter_.is_plain())
        take_filtered();
    count_missed();
}

/// Takes a step with a filter of several solutions: runs the same graph for each further solution, with the same
/// factors.
void ConvergedStepper::take_filtered()
{
    InterfaceResult sum = reached_.last;
    // Vᵏ minus the first solution; apply_filter turns it into the part that the whole filter subtracts from Vᵏ.
    PointBlocks rest(1);
    set_rows(rest.front(), positions_.rows());
    for_each(run_in_parallel, static_cast<Index>(positions_.rows()),
             [&](Index v) { rest.front().row(v) = before_->row(v) - positions_.row(v); });
    PointBlocks solution(1);
    const auto solve_for = [&](const PointBlocks& data) -> const PointBlocks& {
        // The graph solves within positions_: its content is put aside, and swapped back below.
        solution.front().swap(positions_);
        copy(run_in_parallel, data.front(), positions_);
        data_ = &data.front();
        graph_.run(0, loops_.parts());
        data_ = nullptr;
        sum.iterations += reached_.last.iterations;
        sum.residual = std::max(sum.residual, reached_.last.residual);
        sum.stagnated |= reached_.last.stagnated;
        solution.front().swap(positions_);
        return solution;
    };
    set_rows(solution.front(), positions_.rows());
    apply_filter(filter_, rest, solve_for, run_in_parallel);
    for_each(run_in_parallel, static_cast<Index>(positions_.rows()),
             [&](Index v) { positions_.row(v) = before_->row(v) - rest.front().row(v); });
    reached_.last = sum;
}

/// Counts the step if it has missed the tolerance, or has stagnated; a repeated step (DataSteps::Again) counts once.
void ConvergedStepper::count_missed()
{
    reached_.of_step.resize(std::max(reached_.of_step.size(), usize(reached_.n_taken) + 1));
    Missed& counted = reached_.of_step[usize(reached_.n_taken++)];
    // Negated, so that a residual of NaN misses the tolerance.
    const Missed now{.is_short = !(reached_.last.residual <= stop_.tolerance),
                     .has_stagnated = reached_.last.stagnated};
    reached_.n_short_of_tolerance += now.is_short && !counted.is_short ? 1 : 0;
    reached_.n_stagnated += now.has_stagnated && !counted.has_stagnated ? 1 : 0;
    counted.is_short |= now.is_short;
    counted.has_stagnated |= now.has_stagnated;
}

/// Solves the equation, and adds its time and its estimated distance to those of earlier solutions.
void ConvergedStepper::solve()
{
    const Stopwatch watch;
    reached_.last = solve_equation(stop_, loops_.begin());
    loops_.end();
    reached_.distance = std::hypot(reached_.distance, reached_.last.estimated_distance);
    seconds_.back().interface += watch.seconds();
}

void ConvergedStepper::set_positions(const Points& image, const SimilarityOfComponents&)
{
    copy(run_in_parallel, image, positions_);
}

void ConvergedStepper::set_data(const Points& data, DataSteps steps)
{
    set_positions(data, {});
    // With DataSteps::Again the count goes back: the next steps repeat those since the last DataSteps::Further.
    if (steps == DataSteps::Further)
        reached_.n_before_data = reached_.n_taken;
    reached_.n_taken = reached_.n_before_data;
}

void ConvergedStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {reached_.distance, static_cast<double>(reached_.n_short_of_tolerance),
                      static_cast<double>(reached_.n_stagnated)};
}

void ConvergedStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    restore_further(reader);
    reached_.distance = reader.number();
    reached_.n_short_of_tolerance = reader.count();
    reached_.n_stagnated = reader.count();
    reader.require_end();
}

void ConvergedStepper::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_tasks : seconds_)
        seconds.add_tasks(of_tasks);
}

void ConvergedStepper::report_to(StepReport& report) const
{
    report.iterations = reached_.last.iterations;
    report.residual = reached_.last.residual;
    report.estimated_v_max = reached_.distance;
}

void ConvergedStepper::describe_steps(FlowReport& report) const
{
    add_seconds(report.seconds);
    report.convergence.steps_short_of_tolerance = reached_.n_short_of_tolerance;
    report.convergence.steps_stagnated = reached_.n_stagnated;
    remark_on_missed_tolerance(stop_.iterations, report);
    report.schedule = graph_.schedule();
}

}  // namespace seamflow
