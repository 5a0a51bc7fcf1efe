#include "engine/steppers/schur_stepper.h"

#include <algorithm>
#include <cassert>

#include "engine/measure/remarks.h"
#include "engine/memory/release.h"
#include "engine/setup/automatic_choices.h"
#include "engine/tasks/parallel_loop.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
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
    : decomposition_(decompose(mesh, topology, cut.labels, cut.n_parts, progress.loop()))
    , equation_(decomposition_, balancing_for(mesh, cut.n_parts, options.time_step))
    , loops_(static_cast<double>(cut.n_parts), progress)
    , convergence_(options.accuracy.tolerance.value(), options.accuracy.converge_iterations)
    , time_step_(options.time_step)
    , positions_(mesh.vertices)
    , seconds_(decomposition_.sub_meshes.size() + 1)
    , graph_(options.report.record_schedule, progress)
{
    interface_.condensed.resize(equation_.copies().n_copies(), 3);
    make_systems(options, progress);
    make_graph();
}

void SchurStepper::make_systems(const FlowOptions& options, Progress& progress)
{
    systems_.of.resize(decomposition_.sub_meshes.size());
    progress.expect(static_cast<double>(systems_.of.size()));
    for_each(run_in_parallel, static_cast<Index>(systems_.of.size()), [&](Index s) {
        progress.require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        run_for_sub_mesh(sub_mesh, s, [&] {
            systems_.of[s] = std::make_unique<NeumannSystem>(sub_mesh, options.laplacian);
            release_faces(systems_.of[s]->faces_in_use(), sub_mesh);
        });
        progress.count();
    });
    release_surroundings(decomposition_);
    for (const auto& system : systems_.of)
        systems_.views.push_back(system.get());
    limit_factors(options);
}

void SchurStepper::limit_factors(const FlowOptions& options)
{
    std::vector<FactorBytes> bytes;
    for (const auto& system : systems_.of)
        bytes.push_back({system->factor_bytes(), system->bytes_on_interface()});
    factors_.kept = choose_kept_factors(bytes, options.resources.memory_limit, factors_.workspaces.size());
    for (std::size_t s = 0; s < systems_.of.size(); ++s)
        if (factors_.kept.whole[s] == 0)
            systems_.of[s]->borrow_memory();
    factors_.passing.use_blocks_of(factors_.kept.bytes_per_place);
    factors_.workspaces.use(factors_.passing);
}

void SchurStepper::make_graph()
{
    const auto add_task = [&](TaskKind phase, Index s, void (SchurStepper::*task)(Index)) {
        return graph_.add_task({phase, s, TaskPriority::Normal}, [this, s, task] {
            run_for_sub_mesh(decomposition_.sub_meshes[s], s, [&] { (this->*task)(s); });
        });
    };
    const auto root = graph_.add_root();
    const auto solved =
        graph_.add_task({TaskKind::SolveInterface, -1, TaskPriority::Normal}, [this] { solve_interface(); });
    graph_.add_dependency(root, solved);
    std::vector<StepGraph::Node> passing_eliminated;
    std::vector<StepGraph::Node> passing_filled;
    for (Index s = 0; s < static_cast<Index>(systems_.of.size()); ++s) {
        const auto eliminated = add_task(TaskKind::Condense, s, &SchurStepper::eliminate);
        const auto filled = add_task(TaskKind::BackSubstitute, s, &SchurStepper::fill_in);
        graph_.add_dependency(root, eliminated);
        graph_.add_dependency(eliminated, solved);
        graph_.add_dependency(solved, filled);
        if (!is_kept(s)) {
            passing_eliminated.push_back(eliminated);
            passing_filled.push_back(filled);
        }
    }
    take_turns(passing_eliminated);
    take_turns(passing_filled);
}

/// Each waits until one before it has given back the place of its factor.
void SchurStepper::take_turns(const std::vector<StepGraph::Node>& tasks)
{
    for (std::size_t i = at(factors_.kept.n_places); i < tasks.size(); ++i)
        graph_.add_dependency(tasks[i - at(factors_.kept.n_places)], tasks[i]);
}

void SchurStepper::step(const Points& before)
{
    assert(&before != &positions_);
    before_ = &before;
    graph_.run(0, loops_.parts());
}

void SchurStepper::assemble(Index s, SolverWorkspace& workspace)
{
    const SubMesh& sub_mesh = decomposition_.sub_meshes[s];
    set_rows(workspace.positions, sub_mesh.n_vertices);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        workspace.positions.row(v) = before_->row(sub_mesh.local_to_global[v]);
    systems_.of[s]->assemble(workspace.positions, time_step_, workspace);
}

void SchurStepper::eliminate(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = factors_.workspaces.local();
    NeumannSystem& system = *systems_.of[s];
    assemble(s, workspace);
    seconds_[s].assemble += watch.lap();
    system.factorise(workspace);
    seconds_[s].factorise += watch.lap();
    Points& eliminated = workspace.increment;
    system.condense(eliminated, interface_.condensed.middleRows(equation_.copies().first[s], system.n_interface()),
                    workspace);
    if (!is_kept(s))
        system.give_back_interior(workspace);
    const std::vector<Index>& global = decomposition_.sub_meshes[s].local_to_global;
    const std::vector<Index>& vertices = system.unknowns();
    for (Index u = 0; u < system.n_interior(); ++u)
        positions_.row(global[vertices[u]]) = eliminated.row(u);
    seconds_[s].solve += watch.lap();
}

void SchurStepper::solve_interface()
{
    const Stopwatch watch;
    interface_.guess.swap(interface_.update);
    const IterationStop stop{convergence_.tolerance(), convergence_.most_iterations()};
    const InterfaceResult result = equation_.solve(systems_.views, interface_.condensed, interface_.guess, stop,
                                                   interface_.update, loops_.begin());
    loops_.end();
    convergence_.add({result.iterations, result.residual, result.estimated_distance, result.stagnated});
    seconds_.back().interface += watch.seconds();
}

void SchurStepper::fill_in(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = factors_.workspaces.local();
    NeumannSystem& system = *systems_.of[s];
    if (!is_kept(s)) {
        assemble(s, workspace);
        seconds_[s].assemble += watch.lap();
        system.factorise_again(workspace);
        seconds_[s].factorise += watch.lap();
    }
    const SubMesh& sub_mesh = decomposition_.sub_meshes[s];
    const std::vector<Index>& vertices = system.unknowns();
    Points& solution = workspace.increment;
    set_rows(solution, static_cast<Eigen::Index>(vertices.size()));
    for (Index u = 0; u < system.n_interior(); ++u)
        solution.row(u) = positions_.row(sub_mesh.local_to_global[vertices[u]]);
    const Index first = equation_.copies().first[s];
    for (Index i = 0; i < system.n_interface(); ++i)
        solution.row(system.n_interior() + i) = interface_.update.row(equation_.copies().vertex[first + i]);
    system.fill_in(solution);
    for (std::size_t u = 0; u < vertices.size(); ++u)
        if (sub_mesh.owned[vertices[u]] != 0)
            positions_.row(sub_mesh.local_to_global[vertices[u]]) =
                before_->row(sub_mesh.local_to_global[vertices[u]]) + solution.row(static_cast<Eigen::Index>(u));
    if (!is_kept(s))
        system.give_back(workspace);
    seconds_[s].solve += watch.lap();
}

void SchurStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.arrays = {interface_.update};
    convergence_.save(memory);
}

void SchurStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    interface_.update = reader.array_or_none(equation_.copies().n_vertices());
    convergence_.restore(reader);
    reader.require_end();
}

void SchurStepper::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_sub_mesh : seconds_) {
        seconds.assemble += of_sub_mesh.assemble;
        seconds.factorise += of_sub_mesh.factorise;
        seconds.solve += of_sub_mesh.solve;
        seconds.interface += of_sub_mesh.interface;
    }
}

void SchurStepper::describe(StepReport& report) const
{
    convergence_.describe(report);
}

void SchurStepper::describe(FlowReport& report) const
{
    report.cut.interface_vertices = decomposition_.n_interface_vertices;
    report.resources.live_factors = factors_.kept.n_live();
    report.resources.factor_memory_bytes = factors_.kept.bytes + factors_.passing.bytes();
    for (const SubMesh& sub_mesh : decomposition_.sub_meshes)
        report.cut.sub_meshes.push_back({static_cast<Index>(sub_mesh.faces.size()), sub_mesh.n_vertices});
    add_seconds(report.seconds);
    convergence_.describe(report, {});
    report.schedule = graph_.schedule();
}

}  // namespace seamflow
