#include "engine/steppers/schur_stepper.h"

#include <algorithm>
#include <utility>

#include "engine/setup/automatic_choices.h"
#include "engine/tasks/parallel_loop.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// Wider sub-meshes, in √dt, do without a coarse space: it would save an iteration in nine, and cost more.
constexpr double width_without_coarse_space = 8.0;

Balancing balancing_for(const PolygonMesh& mesh, Index n_parts, double time_step)
{
    return width_in_diffusion_lengths(total_area(mesh), n_parts, time_step) < width_without_coarse_space
               ? Balancing::Coarse
               : Balancing::None;
}

}  // namespace

SchurStepper::SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const FlowOptions& options, Progress& progress)
    : SchurStepper(decompose(mesh, topology, cut.labels, cut.n_parts, progress.loop()), mesh, options, progress)
{
}

SchurStepper::SchurStepper(Decomposition decomposition, const PolygonMesh& mesh, const FlowOptions& options,
                           Progress& progress)
    : ConvergedStepper(mesh, static_cast<Index>(decomposition.sub_meshes.size()), options,
                       static_cast<double>(decomposition.sub_meshes.size()), progress)
    , parts_(decomposition.sub_meshes.size())
    , equation_(decomposition,
                balancing_for(mesh, static_cast<Index>(decomposition.sub_meshes.size()), options.time_step))
{
    interface_.n_vertices = decomposition.n_interface_vertices;
    interface_.complements.resize(parts_.size());
    interface_.condensed.resize(equation_.copies().n_copies(), 3);
    make_systems(decomposition, options, progress);
    limit_factors(options);
    make_graph();
}

/// What is needed of sub-meshes later moves to where it is needed; the rest is no more when all are analysed.
void SchurStepper::make_systems(Decomposition& decomposition, const FlowOptions& options, Progress& progress)
{
    progress.expect(static_cast<double>(parts_.size()));
    for_each(run_in_parallel, static_cast<Index>(parts_.size()), [&](Index s) {
        progress.require_going_on();
        SubMesh sub_mesh = std::move(decomposition.sub_meshes[s]);
        run_for_sub_mesh(sub_mesh, s, [&] {
            IndexLists faces = std::move(sub_mesh.face_vertices);
            parts_[s].system = std::make_unique<NeumannSystem>(sub_mesh, std::move(faces), options.laplacian);
        });
        parts_[s].sub_mesh = {std::move(sub_mesh.faces), sub_mesh.n_vertices, std::move(sub_mesh.local_to_global),
                              std::move(sub_mesh.owned)};
        progress.count();
    });
}

void SchurStepper::limit_factors(const FlowOptions& options)
{
    std::vector<FactorBytes> bytes;
    for (const Part& part : parts_)
        bytes.push_back({part.system->factor_bytes(), SchurComplement::copy_bytes(part.system->n_interface())});
    factors_.plan = choose_kept_factors(bytes, options.resources.memory_limit, workspaces_.size());
    factors_.passing.emplace(factors_.plan.bytes_per_place);
}

void SchurStepper::make_graph()
{
    const auto add_task = [&](TaskKind phase, Index s, void (SchurStepper::*task)(Index)) {
        return graph_.add_task({phase, s, TaskPriority::Normal},
                               [this, s, task] { run_for_sub_mesh(parts_[s].sub_mesh, s, [&] { (this->*task)(s); }); });
    };
    std::vector<StepGraph::Node> passing_condensed;
    std::vector<StepGraph::Node> passing_substituted;
    for (Index s = 0; s < static_cast<Index>(parts_.size()); ++s) {
        const auto condensed = add_task(TaskKind::Condense, s, &SchurStepper::condense);
        const auto substituted = add_task(TaskKind::BackSubstitute, s, &SchurStepper::back_substitute);
        graph_.add_dependency(root_, condensed);
        graph_.add_dependency(condensed, equation_solved_);
        graph_.add_dependency(equation_solved_, substituted);
        if (!is_kept(s)) {
            passing_condensed.push_back(condensed);
            passing_substituted.push_back(substituted);
        }
    }
    take_turns(passing_condensed);
    take_turns(passing_substituted);
}

/// Each waits until one before it has given back the place of its factor.
void SchurStepper::take_turns(const std::vector<StepGraph::Node>& tasks)
{
    for (std::size_t i = at(factors_.plan.n_places); i < tasks.size(); ++i)
        graph_.add_dependency(tasks[i - at(factors_.plan.n_places)], tasks[i]);
}

/// The equations of a sub-mesh, and their factor.
std::pair<NeumannSystem::Assembled, LdlSolver::Factor> SchurStepper::assemble_and_factorise(Index s,
                                                                                            SolverWorkspace& workspace)
{
    Stopwatch watch;
    const Part& part = parts_[s];
    const auto own = std::span(part.sub_mesh.local_to_global).first(part.sub_mesh.n_vertices);
    const NeumannSystem::Assembled equations = part.system->assemble(localised(own, workspace), time_step_, workspace);
    seconds_[s].assemble += watch.lap();
    FactorMemory& memory = is_kept(s) ? factors_.kept : *factors_.passing;
    LdlSolver::Factor factor = part.system->factorise(equations, memory, workspace.ldl);
    seconds_[s].factorise += watch.lap();
    return {equations, std::move(factor)};
}

void SchurStepper::condense(Index s)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    part.factor.reset();
    auto [equations, factor] = assemble_and_factorise(s, workspace);
    Stopwatch watch;
    Points& condensed = workspace.increment;
    part.system->condense(equations, factor, condensed);
    const Index n = part.system->n_interface();
    interface_.condensed.middleRows(equation_.copies().first[s], n) = condensed.bottomRows(n);
    interface_.complements[s].take(factor,
                                   is_kept(s) ? SchurComplement::Storage::Factor : SchurComplement::Storage::Copy);
    if (is_kept(s))
        part.factor = std::move(factor);
    const std::vector<Index>& vertices = part.system->unknowns();
    for (Index u = 0; u < part.system->n_interior(); ++u)
        positions_.row(part.sub_mesh.local_to_global[vertices[u]]) = condensed.row(u);
    seconds_[s].solve += watch.lap();
}

InterfaceResult SchurStepper::solve_equation(const IterationStop& stop, const Loop& loop)
{
    interface_.guess.swap(interface_.update);
    return equation_.solve(interface_.complements, interface_.condensed, interface_.guess, stop, interface_.update,
                           loop);
}

void SchurStepper::back_substitute(Index s)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    const LdlSolver::Factor factor =
        part.factor ? *std::exchange(part.factor, std::nullopt) : assemble_and_factorise(s, workspace).second;
    Stopwatch watch;
    const Index n_interior = part.system->n_interior();
    const std::vector<Index>& vertices = part.system->unknowns();
    const std::vector<Index>& global = part.sub_mesh.local_to_global;
    Points& solution = workspace.increment;
    set_rows(solution, static_cast<Eigen::Index>(vertices.size()));
    for (Index u = 0; u < n_interior; ++u)
        solution.row(u) = positions_.row(global[vertices[u]]);
    const Index first = equation_.copies().first[s];
    for (Index i = 0; i < part.system->n_interface(); ++i)
        solution.row(n_interior + i) = interface_.update.row(equation_.copies().vertex[first + i]);
    NeumannSystem::back_substitute(factor, solution);
    for (std::size_t u = 0; u < vertices.size(); ++u)
        if (part.sub_mesh.owned[vertices[u]] != 0)
            positions_.row(global[vertices[u]]) =
                before_->row(global[vertices[u]]) + solution.row(static_cast<Eigen::Index>(u));
    seconds_[s].solve += watch.lap();
}

void SchurStepper::save(StepMemory& memory) const
{
    ConvergedStepper::save(memory);
    memory.arrays = {interface_.update};
}

void SchurStepper::restore_further(StepMemoryReader& memory)
{
    interface_.update = memory.array_or_none(equation_.copies().n_vertices());
}

void SchurStepper::describe(FlowReport& report) const
{
    report.cut.interface_vertices = interface_.n_vertices;
    report.resources.live_factors = factors_.plan.n_live();
    report.resources.factor_memory_bytes = factors_.plan.bytes + factors_.passing->bytes();
    describe_parts(parts_, {}, report);
}

}  // namespace seamflow
