#include "engine/steppers/explicit_stepper.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "solvers/laplacian/mean_curvature.h"

namespace seamflow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest stable dt on regular grids, as a fraction of the squared shortest edge.
constexpr double safe_part = 0.25;

/// The squared length of the shortest edge at a vertex, ignoring edges without length.
double shortest_edge_squared(const PolygonMesh& mesh, const Topology& topology, const Points& positions, Index v)
{
    double shortest = infinity;
    for (const Index corner : topology.corners_at(v))
        for (const Index end : {topology.next(mesh, corner), topology.previous(mesh, corner)}) {
            const double squared = (positions.row(mesh.face_vertices[end]) - positions.row(v)).squaredNorm();
            if (squared > 0.0)
                shortest = std::min(shortest, squared);
        }
    return shortest;
}

}  // namespace

double largest_explicit_step(const PolygonMesh& mesh, const Topology& topology, const Points& positions)
{
    const auto keep_shorter = [](double& shortest, double found) { shortest = std::min(shortest, found); };
    return reduce(
        run_in_parallel, mesh.n_vertices(), infinity,
        [&](double& shortest, Index v) {
            if (topology.moves(v))
                keep_shorter(shortest, shortest_edge_squared(mesh, topology, positions, v));
        },
        keep_shorter);
}

ExplicitStepper::ExplicitStepper(const PolygonMesh& mesh, const Topology& topology, const StepEquation& equation,
                                 Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , progress_(&progress)
    , laplacian_(equation.laplacian)
    , time_step_(equation.time_step)
    , step_scales_(equation.terms.step_scales.begin(), equation.terms.step_scales.end())
    , positions_(mesh.vertices)
    , first_limit_(infinity)
    , smallest_limit_(infinity)
{
}

/// Records largest_explicit_step at these positions.
/// @throws OptionError before the first step, if dt is above it.
void ExplicitStepper::require_stable(const Points& positions)
{
    const double limit = largest_explicit_step(*mesh_, *topology_, positions);
    const bool is_first = smallest_limit_ == infinity;
    smallest_limit_ = std::min(smallest_limit_, limit);
    if (!is_first)
        return;
    first_limit_ = limit;
    if (time_step_ > limit)
        throw OptionError(
            Wording{fmt::format("<time_step> is {:.17g}, but must be at most {:.17g} (length²), the square of the "
                                "shortest edge, for explicit Euler steps to be stable: use a smaller one, or "
                                "backward Euler steps",
                                time_step_, limit)});
}

void ExplicitStepper::step(const Points& before)
{
    assert(&before != &positions_);
    require_stable(before);
    // Vᵏ⁺¹ = Vᵏ - s dt Δ(Vᵏ) Vᵏ
    for_each(progress_->counted_loop(), mesh_->n_vertices(), [&](Index v) {
        if (topology_->moves(v))
            positions_.row(v) = before.row(v) - (step_scales_.empty() ? 1.0 : step_scales_[v]) * time_step_ *
                                                    mean_curvature_vector(*mesh_, *topology_, before, laplacian_, v);
    });
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: use a smaller time step or backward Euler steps");
}

void ExplicitStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {first_limit_, smallest_limit_};
}

void ExplicitStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    first_limit_ = reader.number();
    smallest_limit_ = reader.number();
    reader.require_end();
}

void ExplicitStepper::report_to(FlowReport& report) const
{
    if (mesh_->n_faces() == 0)
        return;
    report.cut.sub_meshes = {{mesh_->n_faces(), mesh_->n_vertices()}};
    if (time_step_ > smallest_limit_)
        report.remarks.push_back({"unstable",
                                  {{"time step", time_step_}, {"limit", smallest_limit_}},
                                  {"Edges have shrunk so far that the time step is above the square of the shortest "
                                   "one: explicit Euler steps may no longer be stable."}});
    else if (time_step_ > safe_part * first_limit_)
        report.remarks.push_back({"unstable",
                                  {{"time step", time_step_}, {"limit", first_limit_}},
                                  {"The time step is above a quarter of the square of the shortest edge: explicit "
                                   "Euler steps may not be stable."}});
}

}  // namespace seamflow
