#include "engine/steppers/schur_stepper.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/setup/automatic_choices.h"
#include "engine/setup/sub_mesh_options.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// Wider sub-meshes, in √dt, do without a coarse space: it would save an iteration in nine, and cost more.
constexpr double width_without_coarse_space = 8.0;

/// What back substitution in single precision leaves of a residual, at most.
constexpr double left_by_single = 1e-4;

/// The area of all sub-meshes of all peers.
double area_of_all(const Decomposition& decomposition, const PolygonMesh& mesh, InterfacePeers& peers)
{
    std::vector<double> areas(at(peers.n_places()), 0.0);
    for_each(run_in_parallel, static_cast<Index>(decomposition.sub_meshes.size()), [&](Index s) {
        if (peers.is_own(s))
            for (const Index f : decomposition.sub_meshes[s].faces)
                areas[peers.places()[s]] += area(mesh.face(f), mesh.vertices);
    });
    return SumTree(peers).add_up(areas, 1).front();
}

Balancing balancing_for(const Decomposition& decomposition, const PolygonMesh& mesh, InterfacePeers& peers,
                        double time_step)
{
    const double area = area_of_all(decomposition, mesh, peers);
    return width_in_diffusion_lengths(area, peers.n_places(), time_step) < width_without_coarse_space
               ? Balancing::Coarse
               : Balancing::None;
}

/// Those of one that has all.
PeerSubMeshes alone(Decomposition decomposition)
{
    auto peers = std::make_unique<OnePeer>(static_cast<Index>(decomposition.sub_meshes.size()));
    return {std::move(decomposition), std::move(peers), {}};
}

}  // namespace

SchurStepper::SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const FlowOptions& options, Progress& progress)
    : SchurStepper(mesh, alone(decompose(mesh, topology, cut.labels, cut.n_parts, progress.exec())), options, progress)
{
}

SchurStepper::SchurStepper(const PolygonMesh& mesh, PeerSubMeshes sub_meshes, const FlowOptions& options,
                           Progress& progress)
    : ConvergedStepper(mesh, static_cast<Index>(sub_meshes.decomposition.sub_meshes.size()), options,
                       static_cast<double>(sub_meshes.decomposition.sub_meshes.size()), progress)
    , peers_(std::move(sub_meshes.peers))
    , run_for_(std::move(sub_meshes.run_for))
    , parts_(sub_meshes.decomposition.sub_meshes.size())
    , equation_(sub_meshes.decomposition, balancing_for(sub_meshes.decomposition, mesh, *peers_, options.time_step),
                *peers_)
{
    Decomposition& decomposition = sub_meshes.decomposition;
    factors_.precision = options.resources.precision;
    interface_.n_vertices = decomposition.n_interface_vertices;
    interface_.complements.resize(parts_.size());
    interface_.condensed.resize(equation_.copies().n_copies(), 3);
    make_systems(decomposition, mesh, options, progress);
    limit_factors(options);
    make_graph();
}

void SchurStepper::run_for(Index s, const std::function<void()>& body) const
{
    if (run_for_)
        run_for_(s, body);
    else
        run_for_sub_mesh(parts_[s].sub_mesh, s, body);
}

/// What is needed of sub-meshes later moves to where it is needed; the rest is no more when all are analysed.
void SchurStepper::make_systems(Decomposition& decomposition, const PolygonMesh& mesh, const FlowOptions& options,
                                Progress& progress)
{
    const FlowTerms terms = terms_of(options, mesh.vertices);
    progress.expect(static_cast<double>(parts_.size()));
    for_each(run_in_parallel, static_cast<Index>(parts_.size()), [&](Index s) {
        progress.require_going_on();
        progress.count();
        if (!is_own(s))
            return;
        SubMesh sub_mesh = std::move(decomposition.sub_meshes[s]);
        OwnVertices& own = parts_[s].sub_mesh;
        own.faces = std::move(sub_mesh.faces);
        own.n_vertices = sub_mesh.n_vertices;
        run_for(s, [&] {
            IndexLists faces = std::move(sub_mesh.face_vertices);
            parts_[s].system =
                std::make_unique<NeumannSystem>(sub_mesh, std::move(faces), laplacian_of(options), terms);
        });
        own.local_to_global = std::move(sub_mesh.local_to_global);
        own.owned = std::move(sub_mesh.owned);
    });
}

/// Of factors that may be in either precision, those in double precision count.
void SchurStepper::limit_factors(const FlowOptions& options)
{
    std::vector<std::size_t> bytes;
    for (const Part& part : parts_)
        if (part.system)
            bytes.push_back(factors_.precision == Precision::Single ? part.system->factor_bytes<float>()
                                                                    : part.system->factor_bytes<double>());
    factors_.plan = choose_kept_factors(bytes, options.resources.memory_limit, workspaces_.size());
    std::vector<std::uint8_t> whole(parts_.size(), 1);
    auto next = factors_.plan.whole.begin();
    for (std::size_t s = 0; s < parts_.size(); ++s)
        if (parts_[s].system)
            whole[s] = *next++;
    factors_.plan.whole = std::move(whole);
    factors_.passing.emplace(factors_.plan.bytes_per_place);
    if (options.resources.memory_limit)
        factors_.memory = std::pmr::new_delete_resource();
    else
        factors_.memory = &factors_.pool;
}

void SchurStepper::make_graph()
{
    const auto add_task = [&](TaskKind phase, Index s, void (SchurStepper::*task)(Index)) {
        return graph_.add_task({phase, s, TaskPriority::Normal},
                               [this, s, task] { run_for(s, [&] { (this->*task)(s); }); });
    };
    std::vector<StepGraph::Node> passing_condensed;
    std::vector<StepGraph::Node> passing_substituted;
    for (Index s = 0; s < static_cast<Index>(parts_.size()); ++s) {
        if (!is_own(s))
            continue;
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

/// Vᵏ⁺¹ - Vᵏ, as far as the step has come: in the interior it stands in the place of the positions.
/// @param increments receives #own by 3.
void SchurStepper::fetch_increments(Index s, Points& increments) const
{
    const Part& part = parts_[s];
    const std::vector<Index>& vertices = part.system->unknowns();
    const Index n_interior = part.system->n_interior();
    set_rows(increments, part.sub_mesh.n_vertices);
    increments.setZero();
    for (Index u = 0; u < n_interior; ++u)
        increments.row(vertices[u]) = positions_.row(part.sub_mesh.local_to_global[vertices[u]]);
    const Index first = equation_.copies().first[s];
    for (Index i = 0; i < part.system->n_interface(); ++i)
        increments.row(vertices[n_interior + i]) = interface_.reached.row(equation_.copies().vertex[first + i]);
}

/// Those whose factors are made again take turns.
template <class Action>
void SchurStepper::for_each_part(const Executor& exec, Action&& action)
{
    const auto act = [&](Index s) { run_for(s, [&] { action(s); }); };
    std::vector<Index> passing;
    for (Index s = 0; s < static_cast<Index>(parts_.size()); ++s)
        if (!is_kept(s))
            passing.push_back(s);
    for_each(exec, static_cast<Index>(parts_.size()), [&](Index s) {
        if (is_own(s) && is_kept(s))
            act(s);
    });
    for_each(exec, factors_.plan.n_places, [&](Index place) {
        for (std::size_t i = at(place); i < passing.size(); i += at(factors_.plan.n_places))
            act(passing[i]);
    });
}

/// The equations of a sub-mesh with the workspace's increments.
NeumannSystem::Assembled SchurStepper::assemble(Index s, SolverWorkspace& workspace) const
{
    const OwnVertices& sub_mesh = parts_[s].sub_mesh;
    const Points& positions = localised(std::span(sub_mesh.local_to_global).first(sub_mesh.n_vertices), workspace);
    const NeumannSystem& system = *parts_[s].system;
    if (data_ == nullptr)
        return system.assemble(positions, workspace.increments, time_step_, workspace);
    const Points& data = localised_data(std::span(sub_mesh.local_to_global).first(sub_mesh.n_vertices), workspace);
    return system.assemble(positions, workspace.increments, data, time_step_, workspace);
}

NeumannSystem::Factor SchurStepper::factorise_and_condense(Index s, SolverWorkspace& workspace)
{
    Stopwatch watch;
    Part& part = parts_[s];
    const NeumannSystem::Assembled equations = assemble(s, workspace);
    seconds_[s].assemble += watch.lap();
    FactorMemory& memory = is_kept(s) ? *factors_.memory : *factors_.passing;
    std::optional<NeumannSystem::Factor> factor =
        part.system->factorise(equations, part.precision, memory, workspace.ldl);
    part.precision = factor && factor->is_single() ? Precision::Single : Precision::Double;
    if (!factor)
        factor = part.system->factorise(equations, part.precision, memory, workspace.ldl);
    seconds_[s].factorise += watch.lap();
    condense_with(s, equations, *factor);
    seconds_[s].solve += watch.lap();
    return *std::move(factor);
}

void SchurStepper::condense_with(Index s, const NeumannSystem::Assembled& equations, NeumannSystem::Factor& factor)
{
    Part& part = parts_[s];
    part.residual.setZero();
    for (const Index v : std::span(part.system->unknowns()).first(part.system->n_interior()))
        part.residual = part.residual.cwiseMax(equations.residual.row(v).cwiseAbs());
    // g_Γ = r_Γ - A_ΓI A_II⁻¹ r_I
    part.system->condense(equations, factor,
                          interface_.condensed.middleRows(equation_.copies().first[s], part.system->n_interface()));
}

/// From increments of 0 on.
/// @param workspace receives them.
void SchurStepper::begin_increments(Index s, SolverWorkspace& workspace)
{
    const Part& part = parts_[s];
    const std::vector<Index>& vertices = part.system->unknowns();
    for (Index u = 0; u < part.system->n_interior(); ++u)
        positions_.row(part.sub_mesh.local_to_global[vertices[u]]).setZero();
    set_rows(workspace.increments, part.sub_mesh.n_vertices);
    workspace.increments.setZero();
}

/// From Vᵏ⁺¹ = Vᵏ on.
void SchurStepper::condense_in(Index s, Precision precision)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    part.factor.reset();
    part.precision = precision;
    begin_increments(s, workspace);
    NeumannSystem::Factor factor = factorise_and_condense(s, workspace);
    part.system->take_schur_complement(factor, workspace.ldl, interface_.complements[s]);
    if (is_kept(s))
        part.factor = std::move(factor);
}

/// With the factor of the first solution of the step, or the same made again.
void SchurStepper::condense_again(Index s)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    begin_increments(s, workspace);
    if (part.factor) {
        Stopwatch watch;
        condense_with(s, assemble(s, workspace), *part.factor);
        seconds_[s].solve += watch.lap();
    } else {
        factorise_and_condense(s, workspace);
    }
}

void SchurStepper::condense(Index s)
{
    if (data_ != nullptr)
        return condense_again(s);
    // Without Γ there is no iteration: one solution is exact.
    const bool is_exact = factors_.precision == Precision::Automatic && parts_[s].system->n_interface() == 0;
    condense_in(s, is_exact ? Precision::Double : factors_.precision);
}

/// The factor as the last condensation has left it.
NeumannSystem::Factor SchurStepper::take_factor(Index s, SolverWorkspace& workspace)
{
    if (parts_[s].factor)
        return *std::exchange(parts_[s].factor, std::nullopt);
    fetch_increments(s, workspace.increments);
    return factorise_and_condense(s, workspace);
}

/// Goes on to an update of Γ.
/// @param factor what condensation has left of it.
/// @param workspace receives the increments.
void SchurStepper::substitute(Index s, NeumannSystem::Factor& factor, const Points& update, SolverWorkspace& workspace)
{
    const NeumannSystem& system = *parts_[s].system;
    fetch_increments(s, workspace.increments);
    Points change(system.n_interface(), 3);
    const Index first = equation_.copies().first[s];
    for (Index i = 0; i < system.n_interface(); ++i) {
        const Index v = equation_.copies().vertex[first + i];
        change.row(i) = update.row(v) - interface_.reached.row(v);
        workspace.increments.row(system.unknowns()[system.n_interior() + i]) = update.row(v);
    }
    // x_I = A_II⁻¹ (r_I - A_IΓ x_Γ)
    system.back_substitute(factor, change, workspace.increments);
}

/// Goes on to an update of Γ, and condenses what it leaves.
void SchurStepper::refine(Index s, const Points& update)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    NeumannSystem::Factor factor = take_factor(s, workspace);
    substitute(s, factor, update, workspace);
    const std::vector<Index>& vertices = part.system->unknowns();
    for (Index u = 0; u < part.system->n_interior(); ++u)
        positions_.row(part.sub_mesh.local_to_global[vertices[u]]) = workspace.increments.row(vertices[u]);
    condense_with(s, assemble(s, workspace), factor);
    if (is_kept(s))
        part.factor = std::move(factor);
}

/// @returns what is left on Γ.
Points& SchurStepper::refine_all(const Points& update, const Executor& exec)
{
    for_each_part(exec, [&](Index s) { refine(s, update); });
    interface_.reached = update;
    return interface_.condensed;
}

/// At any peer.
bool SchurStepper::has_single() const
{
    const bool here = std::ranges::any_of(parts_, [](const Part& part) { return part.precision == Precision::Single; });
    return peers_->largest({here ? 1.0 : 0.0}).front() > 0.0;
}

/// The largest in each column, of all peers.
Point SchurStepper::interior_residual() const
{
    Point largest = Point::Zero();
    for (const Part& part : parts_)
        largest = largest.cwiseMax(part.residual);
    const std::vector<double> of_all = peers_->largest({largest[0], largest[1], largest[2]});
    return {of_all[0], of_all[1], of_all[2]};
}

/// Refines the interiors until the back substitution that is still to come leaves no more than the tolerance. Mostly
/// they are so by then.
/// @param first what there was to begin with.
/// @returns whether they have come so far.
bool SchurStepper::refine_interiors(double tolerance, const Point& first, const Executor& exec)
{
    const auto is_small = [&](const Point& residual) {
        return (left_by_single * residual.array() <= tolerance * first.array()).all();
    };
    Point residual = interior_residual();
    while (!is_small(residual)) {
        refine_all(interface_.update, exec);
        const Point before = std::exchange(residual, interior_residual());
        if (residual.maxCoeff() > 0.5 * before.maxCoeff())
            return is_small(residual);
    }
    return true;
}

/// Of each coordinate, whether Γ moves no more along it than rounding of positions would: what is left of such
/// residuals says nothing.
std::array<bool, 3> SchurStepper::at_rest(const Executor& exec) const
{
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    std::vector<double> farthest(parts_.size(), 0.0);
    for_each(exec, static_cast<Index>(parts_.size()), [&](Index s) {
        for (Index v = 0; v < parts_[s].sub_mesh.n_vertices; ++v)
            farthest[s] =
                std::max(farthest[s], before_->row(parts_[s].sub_mesh.local_to_global[v]).cwiseAbs().maxCoeff());
    });
    // Without Γ nothing is known.
    constexpr double unknown = -1.0;
    Point moved = Point::Constant(unknown);
    if (interface_.update.size() > 0)
        moved = interface_.update.cwiseAbs().colwise().maxCoeff();
    const double position = parts_.empty() ? 0.0 : std::ranges::max(farthest);
    const std::vector<double> of_all = peers_->largest({moved[0], moved[1], moved[2], position});
    std::array<bool, 3> rests{};
    for (std::size_t c = 0; c < 3; ++c)
        rests[c] = of_all[c] != unknown && of_all[c] <= rounding * of_all[3];
    return rests;
}

/// @returns stagnation also where refinement of the interiors stagnates.
InterfaceResult SchurStepper::solve_on_interface(const IterationStop& stop, const Executor& exec)
{
    interface_.reached.setZero(equation_.copies().n_vertices(), 3);
    const Point first = interior_residual();
    // Σ S x_Γ = Σ g_Γ over the sub-meshes
    InterfaceResult result = equation_.solve(
        interface_.complements, interface_.condensed,
        [&](const Points& update) -> Points& { return refine_all(update, exec); },
        interface_.has_guess ? &interface_.guess : nullptr, stop, interface_.update, exec);
    const std::array<bool, 3> rests = at_rest(exec);
    if (std::ranges::find(rests, true) != rests.end()) {
        double moving = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            if (!rests[c])
                moving = std::max(moving, result.residuals[static_cast<Eigen::Index>(c)]);
        result.residual = std::min(result.residual, std::max(moving, stop.tolerance));
        result.stagnated &= moving > stop.tolerance;
    }
    if (std::ranges::find(rests, false) != rests.end() && has_single() &&
        !refine_interiors(stop.tolerance, first, exec)) {
        result.residual = std::max(result.residual, largest_ratio(interior_residual(), first));
        result.stagnated = true;
    }
    return result;
}

InterfaceResult SchurStepper::solve_equation(const IterationStop& stop, const Executor& exec)
{
    interface_.guess.swap(interface_.update);
    interface_.has_guess = std::exchange(interface_.has_update, true);
    const InterfaceResult result = solve_on_interface(stop, exec);
    if (!result.stagnated || !has_single() || factors_.precision == Precision::Single)
        return result;
    for_each_part(exec, [&](Index s) { condense_in(s, Precision::Double); });
    return solve_on_interface(stop, exec);
}

void SchurStepper::back_substitute(Index s)
{
    Part& part = parts_[s];
    SolverWorkspace& workspace = workspaces_.local();
    NeumannSystem::Factor factor = take_factor(s, workspace);
    Stopwatch watch;
    substitute(s, factor, interface_.update, workspace);
    const std::vector<Index>& global = part.sub_mesh.local_to_global;
    for (const Index v : part.system->unknowns())
        if (part.sub_mesh.owned[v] != 0)
            positions_.row(global[v]) = data_ != nullptr ? Point(workspace.increments.row(v))
                                                         : before_->row(global[v]) + workspace.increments.row(v);
    if (!filter_.is_plain() && is_kept(s))
        part.factor = std::move(factor);
    seconds_[s].solve += watch.lap();
}

void SchurStepper::save(StepMemory& memory) const
{
    ConvergedStepper::save(memory);
    memory.arrays = {interface_.update};
}

/// Those of Γ.
std::vector<Index> SchurStepper::saved_vertices() const
{
    const InterfaceCopies& copies = equation_.copies();
    std::vector<Index> vertices(at(copies.n_vertices()));
    for (Index s = 0; s < copies.n_sub_meshes(); ++s) {
        if (!is_own(s))
            continue;
        const NeumannSystem& system = *parts_[s].system;
        for (Index i = 0; i < system.n_interface(); ++i)
            vertices[copies.vertex[copies.first[s] + i]] =
                parts_[s].sub_mesh.local_to_global[system.unknowns()[system.n_interior() + i]];
    }
    return vertices;
}

void SchurStepper::restore_further(StepMemoryReader& memory)
{
    interface_.update = memory.array(equation_.copies().n_vertices());
    interface_.has_update = true;
}

void SchurStepper::describe(FlowReport& report) const
{
    report.cut.interface_vertices = interface_.n_vertices;
    report.resources.live_factors = factors_.plan.n_live();
    report.resources.factor_memory_bytes = factors_.passing->bytes();
    for (std::size_t s = 0; s < parts_.size(); ++s) {
        if (!parts_[s].system)
            continue;
        describe_sub_mesh(parts_[s].sub_mesh, 0, 0.0, report);
        const NeumannSystem& system = *parts_[s].system;
        const bool is_single = parts_[s].precision == Precision::Single;
        report.resources.single_factors += is_single ? 1 : 0;
        if (is_kept(static_cast<Index>(s)))
            report.resources.factor_memory_bytes +=
                is_single ? system.factor_bytes<float>() : system.factor_bytes<double>();
    }
    describe_steps({}, report);
}

}  // namespace seamflow
