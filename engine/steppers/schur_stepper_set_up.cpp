// The set-up of SchurStepper; the steps are in schur_stepper.cpp.

#include <memory>
#include <utility>
#include <vector>

#include "engine/setup/automatic_choices.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/tasks/parallel_executor.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The width of sub-meshes, in √dt, above which there is no coarse space: it would save an iteration in nine, and cost
/// more.
constexpr double width_without_coarse_space = 8.0;

/// The area of all sub-meshes of all ranks, in length².
double area_of_all(const Decomposition& decomposition, const PolygonMesh& mesh, InterfaceRanks& ranks)
{
    std::vector<double> areas(usize(ranks.n_sub_meshes()), 0.0);
    for_each(run_in_parallel, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        if (ranks.is_own(s))
            for (const Index f : decomposition.sub_meshes[s].faces)
                areas[ranks.global_numbers()[s]] += area(mesh.face(f), mesh.vertices);
    });
    return SumTree(ranks).add_up(areas, 1).front();
}

/// The preconditioner's kind of balancing: with a coarse space only if the sub-meshes of all ranks are narrow.
/// @param time_step dt, in length².
Balancing balancing_for(const Decomposition& decomposition, const PolygonMesh& mesh, InterfaceRanks& ranks,
                        double time_step)
{
    const double area = area_of_all(decomposition, mesh, ranks);
    return width_in_diffusion_lengths(area, ranks.n_sub_meshes(), time_step) < width_without_coarse_space
               ? Balancing::Coarse
               : Balancing::None;
}

}  // namespace

SchurStepper::SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const StepSettings& settings, const IterationStop& stop, Progress& progress,
                           const GivenStiffness* given)
    : SchurStepper(mesh, alone(decompose(mesh, topology, cut.labels, cut.n_parts, progress.exec())), settings, stop,
                   progress, given)
{
}

SchurStepper::SchurStepper(const PolygonMesh& mesh, RankSubMeshes sub_meshes, const StepSettings& settings,
                           const IterationStop& stop, Progress& progress, const GivenStiffness* given)
    : ConvergedStepper(mesh, static_cast<Index>(sub_meshes.decomposition.sub_meshes.size()), settings, stop,
                       static_cast<double>(sub_meshes.decomposition.sub_meshes.size()), progress)
    , ranks_(std::move(sub_meshes.ranks))
    , names_(std::move(sub_meshes.names))
    , sub_meshes_(sub_meshes.decomposition.sub_meshes.size())
    , equation_(sub_meshes.decomposition,
                balancing_for(sub_meshes.decomposition, mesh, *ranks_, settings.equation.time_step), *ranks_)
{
    Decomposition& decomposition = sub_meshes.decomposition;
    keeps_matrix_ = settings.equation.is_linear();
    changed_.resize(sub_meshes_.size(), 0);
    if (settings.equation.terms.keeps_stiffness)
        initial_ = mesh.vertices;
    factors_.precision = settings.factors.precision;
    interface_.n_vertices = decomposition.n_interface_vertices;
    interface_.complements.resize(sub_meshes_.size());
    interface_.condensed.resize(equation_.copies().n_copies(), 3);
    make_sub_meshes(decomposition, settings.equation, given, progress);
    choose_factors(settings.factors);
    make_graph();
}

/// Makes the sub-meshes. Data of `decomposition` that steps need are moved into them; the rest is freed when all are
/// analysed.
void SchurStepper::make_sub_meshes(Decomposition& decomposition, const StepEquation& equation,
                                   const GivenStiffness* given, Progress& progress)
{
    const InterfaceCopies& copies = equation_.copies();
    progress.expect(static_cast<double>(sub_meshes_.size()));
    for_each(run_in_parallel, static_cast<Index>(sub_meshes_.size()), [&](Index s) {
        progress.require_going_on();
        progress.count();
        if (!is_own(s))
            return;
        SubMesh sub_mesh = std::move(decomposition.sub_meshes[s]);
        CondensedSubMesh::Vertices own{.faces = std::move(sub_mesh.faces), .n_vertices = sub_mesh.n_vertices};
        std::unique_ptr<NeumannSystem> system;
        run_for_sub_mesh(names_[s], [&] {
            IndexLists faces = std::move(sub_mesh.face_vertices);
            system = std::make_unique<NeumannSystem>(sub_mesh, std::move(faces), equation.laplacian, equation.terms,
                                                     sub_meshes_.size() == 1 ? run_in_parallel : Executor());
        });
        own.local_to_global = std::move(sub_mesh.local_to_global);
        if (given != nullptr)
            system->give(*given, own.local_to_global);
        own.owned = std::move(sub_mesh.owned);
        const auto on_interface = std::span(copies.vertex).subspan(usize(copies.offsets[s]), usize(copies.n_in(s)));
        sub_meshes_[s] = std::make_unique<CondensedSubMesh>(std::move(own), std::move(system), on_interface,
                                                            copies.offsets[s], seconds_[s]);
    });
}

/// Chooses the factors that are kept. Factors that may be in either precision count as double.
void SchurStepper::choose_factors(const FactorSettings& settings)
{
    std::vector<std::size_t> bytes;
    for (const auto& one : sub_meshes_)
        if (one)
            bytes.push_back(factors_.precision == Precision::Single ? one->system().factor_bytes<float>()
                                                                    : one->system().factor_bytes<double>());
    factors_.plan = choose_kept_factors(bytes, settings.memory_limit, workspaces_.size());
    factors_.recomputed.emplace(factors_.plan.bytes_per_slot);
    FactorMemory& kept = settings.memory_limit ? *std::pmr::new_delete_resource() : factors_.pool;
    // The plan has entries for own sub-meshes only; `whole` gets one for each sub-mesh, 1 if it is remote.
    std::vector<std::uint8_t> whole(sub_meshes_.size(), 1);
    auto next = factors_.plan.whole.begin();
    for (std::size_t s = 0; s < sub_meshes_.size(); ++s)
        if (sub_meshes_[s]) {
            whole[s] = *next++;
            sub_meshes_[s]->use_memory(whole[s] != 0 ? kept : *factors_.recomputed, whole[s] != 0);
        }
    factors_.plan.whole = std::move(whole);
}

/// Adds the tasks of all own sub-meshes to the graph: condense before, and back-substitute after the solution on Γ.
void SchurStepper::make_graph()
{
    std::vector<TaskGraph::Node> recomputed_condensed;
    std::vector<TaskGraph::Node> recomputed_substituted;
    for (Index s = 0; s < static_cast<Index>(sub_meshes_.size()); ++s) {
        if (!is_own(s))
            continue;
        const auto condensed =
            graph_.add_task([this, s] { run_for_sub_mesh(names_[s], [&] { condense(s); }); }, {TaskKind::Condense, s});
        const auto substituted = graph_.add_task(
            [this, s] { run_for_sub_mesh(names_[s], [&] { back_substitute(s); }); }, {TaskKind::BackSubstitute, s});
        graph_.add_dependency(root_, condensed);
        graph_.add_dependency(condensed, equation_solved_);
        graph_.add_dependency(equation_solved_, substituted);
        if (!is_kept(s)) {
            recomputed_condensed.push_back(condensed);
            recomputed_substituted.push_back(substituted);
        }
    }
    take_turns(recomputed_condensed);
    take_turns(recomputed_substituted);
}

/// Makes each task wait until an earlier one has freed its slot.
void SchurStepper::take_turns(const std::vector<TaskGraph::Node>& tasks)
{
    for (std::size_t i = usize(factors_.plan.n_slots); i < tasks.size(); ++i)
        graph_.add_dependency(tasks[i - usize(factors_.plan.n_slots)], tasks[i]);
}

}  // namespace seamflow
