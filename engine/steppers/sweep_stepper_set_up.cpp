#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/setup/equation_terms.h"
#include "engine/setup/sub_mesh_options.h"
#include "engine/steppers/sweep_order.h"
#include "engine/steppers/sweep_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/make_sub_mesh.h"
#include "partition/decomposition/overlap.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The sub-meshes of a cut, grown into each other for a sweep in ascending order of `stage`.
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
SweepSubMeshes all_of(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                      std::vector<double> curvature, Progress& progress)
{
    SweepSubMeshes all{.own = alone(decompose(mesh, topology, cut.labels, cut.n_parts, progress.exec()))};
    Decomposition& decomposition = all.own.decomposition;
    all.stage = assign_stages(decomposition.adjacency, options.interface.colouring,
                              total_curvatures(decomposition, std::exchange(curvature, {})));
    if (options.interface.conditions == Conditions::Schwarz)
        decomposition = overlap_sub_meshes(mesh, topology, cut, all.stage, options.interface.overlap);
    progress.require_going_on();
    return all;
}

}  // namespace

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const FlowOptions& options, std::vector<double> curvature, Progress& progress)
    : SweepStepper(mesh, topology, all_of(mesh, topology, cut, options, std::move(curvature), progress), options,
                   progress)
{
}

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, SweepSubMeshes sub_meshes,
                           const FlowOptions& options, Progress& progress)
    : decomposition_(std::move(sub_meshes.own.decomposition))
    , names_(std::move(sub_meshes.own.names))
    , remote_(sub_meshes.remote)
    , windows_(std::move(sub_meshes.windows))
    , ranks_(std::move(sub_meshes.own.ranks))
    , graph_(&progress, options.report.record_schedule)
    , time_step_(options.time_step)
    , filter_(filter_of(options))
    , corrects_(corrects(options))
{
    copy(run_in_parallel, mesh.vertices, positions_);
    if (is_classical(options.interface.conditions))
        copies_.emplace(mesh, decomposition_, options.report.keep_gaps);
    make_states(mesh, options, progress);
    run_both(
        [&] {
            if (options.interface.conditions != Conditions::Schwarz)
                error_.emplace(decomposition_, mesh, topology, options, *ranks_);
        },
        [&] {
            plans_.push_back(make_plan(decomposition_, options, sub_meshes.stage));
            if (alternates(options, usize(ranks_->n_sub_meshes())))
                plans_.push_back(make_plan(decomposition_, options, reversed(sub_meshes.stage)));
        });
    const std::vector<Index> order = reverse_cuthill_mckee(decomposition_.adjacency);
    for (std::size_t sweep = windows_.size(); sweep < plans_.size(); ++sweep)
        windows_.push_back(least_window(plans_[sweep], order_by_need(plans_[sweep], order)));
    choose_factor_window(options);
    if (remote_ != nullptr)
        remote_->connect(decomposition_, plans_, error_->remote_rows());
    const PerformTask perform = [this](TaskKind kind, Index s) { this->perform(kind, s); };
    for (std::size_t sweep = 0; sweep < plans_.size(); ++sweep)
        add_sweep(graph_, perform, sweep, plans_[sweep], decomposition_.adjacency, windows_[sweep], predicts(options),
                  remote_);
}

/// Chooses the size of the windows: large enough that each thread has work within the window, as far as the limit
/// allows; at least as large as is needed to avoid deadlocks.
void SweepStepper::choose_factor_window(const FlowOptions& options)
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
    if (!options.resources.memory_limit)
        return;
    const std::size_t slots = *options.resources.memory_limit / largest;
    if (slots < usize(least))
        throw MemoryLimitError(Wording{"<memory_limit> is " + std::to_string(*options.resources.memory_limit) +
                                       " bytes, but the " + std::to_string(least) +
                                       " factorisations that a step needs at once take " +
                                       std::to_string(usize(least) * largest) + ": raise it, or use more sub-meshes"});
    resize(static_cast<Index>(std::min(usize(enough), slots)));
}

void SweepStepper::make_states(const PolygonMesh& mesh, const FlowOptions& options, Progress& progress)
{
    std::vector<std::optional<SubMeshState>> made(decomposition_.sub_meshes.size());
    const FlowTerms terms = terms_of(options, mesh.vertices);
    progress.expect(static_cast<double>(made.size()));
    for_each(run_in_parallel, static_cast<Index>(made.size()), [&](Index s) {
        progress.require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        if (!is_own(s)) {
            made[s].emplace(sub_mesh, nullptr, mesh.vertices, predicts(options));
            return;
        }
        run_for_sub_mesh(names_[s], [&] {
            auto equations = make_equations(sub_mesh, std::move(sub_mesh.twin), made.size() == 1, options, terms,
                                            workspaces_.local());
            SubMeshState& state = made[s].emplace(sub_mesh, std::move(equations), mesh.vertices, predicts(options));
            state.p = robin_parameter(sub_mesh, state.position, options);
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
