#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/setup/sub_mesh_equations.h"
#include "engine/steppers/sweep_order.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/make_sub_mesh.h"
#include "partition/decomposition/overlap.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The sub-meshes of a cut, grown into each other by layers of faces, for a sweep in ascending order of `stage`.
Decomposition overlap_sub_meshes(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                 std::span<const Index> stage, int layers)
{
    const Overlap overlap{cut.labels, stage, layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        sub_meshes[s] = make_overlapping_sub_mesh(mesh, topology, overlap, s, std::move(faces[s]));
    });
    return connect_overlapping(std::move(sub_meshes), topology, overlap);
}

/// All sub-meshes of a cut.
SweepSubMeshes all_sub_meshes(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                              const SweepSteps& sweeps, std::vector<double> curvature, Progress& progress)
{
    SweepSubMeshes all{.own = alone(decompose(mesh, topology, cut.labels, cut.n_parts, progress.exec()))};
    Decomposition& decomposition = all.own.decomposition;
    all.stage = assign_stages(decomposition.adjacency, sweeps.solves_in_order_of_numbers,
                              total_curvatures(decomposition, std::exchange(curvature, {})));
    if (const auto* const schwarz = std::get_if<SchwarzConditions>(&sweeps.conditions))
        decomposition = overlap_sub_meshes(mesh, topology, cut, all.stage, schwarz->overlap);
    progress.require_going_on();
    return all;
}

}  // namespace

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const StepSettings& settings, const SweepSteps& sweeps, std::vector<double> curvature,
                           Progress& progress)
    : SweepStepper(mesh, topology, all_sub_meshes(mesh, topology, cut, sweeps, std::move(curvature), progress),
                   settings, sweeps, progress)
{
}

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, SweepSubMeshes sub_meshes,
                           const StepSettings& settings, const SweepSteps& sweeps, Progress& progress)
    : decomposition_(std::move(sub_meshes.own.decomposition))
    , names_(std::move(sub_meshes.own.names))
    , remote_(sub_meshes.remote)
    , windows_(std::move(sub_meshes.windows))
    , ranks_(std::move(sub_meshes.own.ranks))
    , graph_(&progress, settings.records_schedule)
    , time_step_(settings.equation.time_step)
    , filter_(settings.equation.filter)
    , corrects_(sweeps.corrects)
{
    copy(run_in_parallel, mesh.vertices, positions_);
    const InterfaceConditions& conditions = sweeps.conditions;
    if (const auto* const classical = std::get_if<ClassicalConditions>(&conditions))
        copies_.emplace(mesh, decomposition_, classical->keeps_gaps);
    make_states(mesh, settings, conditions, progress);
    run_both(
        [&] {
            if (!std::holds_alternative<SchwarzConditions>(conditions))
                error_.emplace(decomposition_, mesh, topology, settings.equation, have_copies(conditions), *ranks_);
        },
        [&] {
            plans_.push_back(make_plan(decomposition_, conditions, sub_meshes.stage));
            if (sweeps.alternates)
                plans_.push_back(make_plan(decomposition_, conditions, reversed(sub_meshes.stage)));
        });
    const std::vector<Index> order = reverse_cuthill_mckee(decomposition_.adjacency);
    for (std::size_t sweep = windows_.size(); sweep < plans_.size(); ++sweep)
        windows_.push_back(least_window(plans_[sweep], order_by_need(plans_[sweep], order)));
    choose_factor_window(settings.factors.memory_limit);
    if (remote_ != nullptr)
        remote_->connect(decomposition_, plans_, error_->remote_rows());
    const PerformTask perform = [this](TaskKind kind, Index s) { this->perform(kind, s); };
    for (std::size_t sweep = 0; sweep < plans_.size(); ++sweep)
        add_sweep(graph_, perform, sweep, plans_[sweep], decomposition_.adjacency, windows_[sweep], predict(conditions),
                  remote_);
}

/// Chooses the size of the windows: large enough that each thread has work within the window, as far as the limit
/// allows; at least as large as is needed to avoid deadlocks.
void SweepStepper::choose_factor_window(std::optional<std::size_t> memory_limit)
{
    constexpr Index slots_per_thread = 4;
    std::size_t largest = 1;
    for (const SubMeshState& state : states_)
        if (state.system)
            largest = std::max(largest, state.system->factor_bytes());
    factors_.emplace(largest);

    const auto n = static_cast<Index>(windows_.front().order.size());
    Index least = 0;
    for (const FactorWindow& window : windows_)
        least = std::max(least, window.size);
    // With a filter of several solutions, all factors are kept, because a further solution begins when the previous one
    // is complete.
    least = filter_.is_plain() ? std::min(least, n) : n;
    const auto resize = [&](Index size) {
        for (FactorWindow& window : windows_)
            window.size = size;
    };
    const Index enough = std::min(n, least + slots_per_thread * workspaces_.size());
    resize(enough);
    if (!memory_limit)
        return;
    const std::size_t slots = *memory_limit / largest;
    if (slots < usize(least))
        throw MemoryLimitError(Wording{"<memory_limit> is " + std::to_string(*memory_limit) + " bytes, but the " +
                                       std::to_string(least) + " factorisations that a step needs at once take " +
                                       std::to_string(usize(least) * largest) + ": raise it, or use more sub-meshes"});
    resize(static_cast<Index>(std::min(usize(enough), slots)));
}

/// Makes the state of each sub-mesh, and analyses the equations of own sub-meshes.
void SweepStepper::make_states(const PolygonMesh& mesh, const StepSettings& settings,
                               const InterfaceConditions& conditions, Progress& progress)
{
    std::vector<std::optional<SubMeshState>> made(decomposition_.sub_meshes.size());
    progress.expect(static_cast<double>(made.size()));
    for_each(run_in_parallel, static_cast<Index>(made.size()), [&](Index s) {
        progress.require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        if (!is_own(s)) {
            made[s].emplace(sub_mesh, nullptr, mesh.vertices, predict(conditions));
            return;
        }
        run_for_sub_mesh(names_[s], [&] {
            auto equations = make_equations(sub_mesh, std::move(sub_mesh.twin), made.size() == 1, settings, conditions,
                                            workspaces_.local());
            SubMeshState& state = made[s].emplace(sub_mesh, std::move(equations), mesh.vertices, predict(conditions));
            state.p = robin_parameter(sub_mesh, state.position, conditions, time_step_);
            if (!state.system->uses_faces())
                keep_faces_at_interface(sub_mesh);
        });
        progress.count();
    });
    states_.reserve(made.size());
    for (auto& state : made)
        states_.push_back(std::move(*state));
}

}  // namespace seamflow
