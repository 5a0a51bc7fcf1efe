#include "engine/converged_flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/choose_subdomains.h"
#include "engine/flow_remarks.h"
#include "engine/on_behalf_of.h"
#include "engine/parallel_loop.h"
#include "engine/release.h"
#include "engine/stopwatch.h"
#include "partition/errors.h"
#include "solvers/set_rows.h"

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

ConvergedFlow::ConvergedFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                             const FlowOptions& options, Progress& progress)
    : progress_(&progress)
    , decomposition_(decompose(mesh, topology, cut.labels, cut.n_parts, progress.loop()))
    , systems_(decomposition_.sub_meshes.size())
    , equation_(decomposition_, balancing_for(mesh, cut.n_parts, options.time_step))
    , loops_(static_cast<double>(cut.n_parts))
    , stop_{options.tolerance.value(), options.converge_iterations}
    , time_step_(options.time_step)
    , positions_(mesh.vertices)
    , condensed_(equation_.copies().n_copies(), 3)
    , seconds_(decomposition_.sub_meshes.size())
    , recorder_(options.record_schedule ? std::make_unique<ScheduleRecorder>() : nullptr)
    , graph_(recorder_.get(), &progress)
{
    make_systems(options);
    make_graph();
}

void ConvergedFlow::make_systems(const FlowOptions& options)
{
    progress_->expect(static_cast<double>(systems_.size()));
    for_each(run_in_parallel, static_cast<Index>(systems_.size()), [&](Index s) {
        progress_->require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[at(s)];
        on_behalf_of(sub_mesh, s, [&] {
            systems_[at(s)] = std::make_unique<NeumannSystem>(sub_mesh, options.laplacian);
            release_faces(systems_[at(s)]->faces_in_use(), sub_mesh);
        });
        progress_->count();
    });
    release_surroundings(decomposition_);
    for (const auto& system : systems_)
        system_views_.push_back(system.get());
    limit_factors(options);
}

void ConvergedFlow::limit_factors(const FlowOptions& options)
{
    std::vector<FactorBytes> bytes;
    for (const auto& system : systems_)
        bytes.push_back({system->factor_bytes(), system->bytes_on_interface()});
    kept_ = choose_kept_factors(bytes, options.memory_limit, workspaces_.size());
    for (std::size_t s = 0; s < systems_.size(); ++s)
        if (kept_.whole[s] == 0)
            systems_[s]->borrow_memory();
    passing_factors_.use_blocks_of(kept_.bytes_per_place);
    workspaces_.use(passing_factors_);
}

template <class Body>
TaskGraph::Node ConvergedFlow::add_task(Phase phase, Index s, Body body)
{
    const auto node = graph_.add_task(body, TaskGraph::Priority::Normal);
    if (recorder_)
        recorder_->add_task(node, {phase, s, TaskGraph::Priority::Normal});
    return node;
}

void ConvergedFlow::make_graph()
{
    root_ = graph_.add_root();
    const auto solved = add_task(Phase::SolveInterface, -1, [this] { solve_interface(); });
    graph_.add_dependency(root_, solved);
    std::vector<TaskGraph::Node> passing_eliminated;
    std::vector<TaskGraph::Node> passing_filled;
    for (Index s = 0; s < static_cast<Index>(systems_.size()); ++s) {
        const SubMesh& sub_mesh = decomposition_.sub_meshes[at(s)];
        const auto eliminated =
            add_task(Phase::Eliminate, s, [this, s, &sub_mesh] { on_behalf_of(sub_mesh, s, [&] { eliminate(s); }); });
        const auto filled =
            add_task(Phase::FillIn, s, [this, s, &sub_mesh] { on_behalf_of(sub_mesh, s, [&] { fill_in(s); }); });
        graph_.add_dependency(root_, eliminated);
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
void ConvergedFlow::take_turns(const std::vector<TaskGraph::Node>& tasks)
{
    for (std::size_t i = at(kept_.n_places); i < tasks.size(); ++i)
        graph_.add_dependency(tasks[i - at(kept_.n_places)], tasks[i]);
}

void ConvergedFlow::step(const Points& before)
{
    assert(&before != &positions_);
    before_ = &before;
    if (recorder_)
        recorder_->begin_step();
    graph_.run(root_, loops_.parts());
    if (recorder_)
        recorder_->end_step();
}

void ConvergedFlow::assemble(Index s, SolverWorkspace& workspace)
{
    const SubMesh& sub_mesh = decomposition_.sub_meshes[at(s)];
    set_rows(workspace.positions, sub_mesh.n_vertices);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        workspace.positions.row(v) = before_->row(sub_mesh.local_to_global[at(v)]);
    systems_[at(s)]->assemble(workspace.positions, time_step_, workspace);
}

void ConvergedFlow::eliminate(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = workspaces_.local();
    NeumannSystem& system = *systems_[at(s)];
    assemble(s, workspace);
    seconds_[at(s)].assemble += watch.lap();
    system.factorise(workspace);
    seconds_[at(s)].factorise += watch.lap();
    Points& eliminated = workspace.increment;
    system.condense(eliminated, condensed_.middleRows(equation_.copies().first[at(s)], system.n_interface()),
                    workspace);
    if (!is_kept(s))
        system.give_back_interior(workspace);
    const std::vector<Index>& global = decomposition_.sub_meshes[at(s)].local_to_global;
    const std::vector<Index>& vertices = system.unknowns();
    for (Index u = 0; u < system.n_interior(); ++u)
        positions_.row(global[at(vertices[at(u)])]) = eliminated.row(u);
    seconds_[at(s)].solve += watch.lap();
}

void ConvergedFlow::solve_interface()
{
    const Stopwatch watch;
    guess_.swap(interface_);
    result_ = equation_.solve(system_views_, condensed_, guess_, stop_, interface_, loops_.begin(*progress_));
    loops_.end(*progress_);
    if (!(result_.residual <= stop_.tolerance))
        ++steps_short_of_tolerance_;
    if (result_.stagnated)
        ++steps_stagnated_;
    distance_ = std::hypot(distance_, result_.estimated_distance);
    interface_seconds_ += watch.seconds();
}

void ConvergedFlow::fill_in(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = workspaces_.local();
    NeumannSystem& system = *systems_[at(s)];
    if (!is_kept(s)) {
        assemble(s, workspace);
        seconds_[at(s)].assemble += watch.lap();
        system.factorise_again(workspace);
        seconds_[at(s)].factorise += watch.lap();
    }
    const SubMesh& sub_mesh = decomposition_.sub_meshes[at(s)];
    const std::vector<Index>& vertices = system.unknowns();
    Points& solution = workspace.increment;
    set_rows(solution, static_cast<Eigen::Index>(vertices.size()));
    for (Index u = 0; u < system.n_interior(); ++u)
        solution.row(u) = positions_.row(sub_mesh.local_to_global[at(vertices[at(u)])]);
    const Index first = equation_.copies().first[at(s)];
    for (Index i = 0; i < system.n_interface(); ++i)
        solution.row(system.n_interior() + i) = interface_.row(equation_.copies().vertex[at(first + i)]);
    system.fill_in(solution);
    for (std::size_t u = 0; u < vertices.size(); ++u)
        if (sub_mesh.owned[at(vertices[u])] != 0)
            positions_.row(sub_mesh.local_to_global[at(vertices[u])]) =
                before_->row(sub_mesh.local_to_global[at(vertices[u])]) + solution.row(static_cast<Eigen::Index>(u));
    if (!is_kept(s))
        system.give_back(workspace);
    seconds_[at(s)].solve += watch.lap();
}

void ConvergedFlow::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.arrays = {interface_};
    memory.numbers = {distance_, static_cast<double>(steps_short_of_tolerance_), static_cast<double>(steps_stagnated_)};
}

void ConvergedFlow::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    interface_ = reader.array_or_none(equation_.copies().n_vertices());
    distance_ = reader.number();
    steps_short_of_tolerance_ = reader.count();
    steps_stagnated_ = reader.count();
    reader.require_end();
}

void ConvergedFlow::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_sub_mesh : seconds_) {
        seconds.assemble += of_sub_mesh.assemble;
        seconds.factorise += of_sub_mesh.factorise;
        seconds.solve += of_sub_mesh.solve;
    }
    seconds.interface += interface_seconds_;
}

void ConvergedFlow::describe(StepReport& report) const
{
    report.iterations = result_.iterations;
    report.residual = result_.residual;
    report.estimated_v_max = distance_;
}

void ConvergedFlow::describe(FlowReport& report) const
{
    report.subdomains = static_cast<Index>(systems_.size());
    report.colors = systems_.empty() ? 0 : 1;
    report.interface_vertices = decomposition_.n_interface_vertices;
    report.subdomain_colors.assign(systems_.size(), 0);
    report.p.assign(systems_.size(), 0.0);
    report.live_factors = kept_.n_live();
    report.factor_memory_bytes = kept_.bytes + passing_factors_.bytes();
    for (const SubMesh& sub_mesh : decomposition_.sub_meshes) {
        report.subdomain_faces.push_back(static_cast<Index>(sub_mesh.faces.size()));
        report.subdomain_vertices.push_back(sub_mesh.n_vertices);
    }
    add_seconds(report.seconds);
    report.steps_short_of_tolerance = steps_short_of_tolerance_;
    report.steps_stagnated = steps_stagnated_;
    remark_on_missed_tolerance(stop_.iterations, {}, report);
    if (recorder_)
        report.schedule = recorder_->schedule();
}

}  // namespace seamflow
