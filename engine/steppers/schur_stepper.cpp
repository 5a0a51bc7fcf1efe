#include "engine/steppers/schur_stepper.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// The largest fraction of a residual that back substitution in single precision leaves.
constexpr double left_by_single = 1e-4;

}  // namespace

/// Calls action(s) for all own sub-meshes. Sub-meshes whose factors are recomputed take turns, so that no more of them
/// run at once than there are slots.
template <class Action>
void SchurStepper::for_each_sub_mesh(const Executor& exec, Action&& action)
{
    const auto act = [&](Index s) { run_for_sub_mesh(names_[s], [&] { action(s); }); };
    std::vector<Index> recomputed;
    for (Index s = 0; s < static_cast<Index>(sub_meshes_.size()); ++s)
        if (!is_kept(s))
            recomputed.push_back(s);
    for_each(exec, static_cast<Index>(sub_meshes_.size()), [&](Index s) {
        if (is_own(s) && is_kept(s))
            act(s);
    });
    for_each(exec, factors_.plan.n_slots, [&](Index slot) {
        for (std::size_t i = usize(slot); i < recomputed.size(); i += usize(factors_.plan.n_slots))
            act(recomputed[i]);
    });
}

/// The data of the present step that all sub-meshes share.
CondensedStep SchurStepper::shared_step()
{
    return {.before = *before_,
            .positions = positions_,
            .data = data_,
            .time_step = time_step_,
            .reached = interface_.reached,
            .condensed = interface_.condensed};
}

/// S = A_ΓΓ - A_ΓI A_II⁻¹ A_IΓ and g = b_Γ - A_ΓI A_II⁻¹ b_I, with A = M + dt K of the sub-mesh's faces and the
/// residual b of Vᵏ.
void SchurStepper::condense(Index s)
{
    if (has_matrix_of(s))
        return sub_meshes_[s]->condense_again(shared_step(), workspaces_.local());
    // Without Γ there is no iteration: one solution must be exact.
    const bool is_exact = factors_.precision == Precision::Automatic && equation_.copies().n_in(s) == 0;
    sub_meshes_[s]->condense(shared_step(), is_exact ? Precision::Double : factors_.precision, workspaces_.local(),
                             interface_.complements[s]);
}

/// Solves for the interior of every own sub-mesh, given an update of Γ since Vᵏ, and condenses the residual of the
/// equations: each sub-mesh writes its rows of interface_.condensed.
/// @returns the residual on Γ, one row per copy, valid until the next call.
Points& SchurStepper::refine_all(const Points& update, const Executor& exec)
{
    for_each_sub_mesh(exec, [&](Index s) { sub_meshes_[s]->refine(shared_step(), update, workspaces_.local()); });
    interface_.reached = update;
    return interface_.condensed;
}

/// Whether any sub-mesh, of any rank, has a factor in single precision.
bool SchurStepper::has_single() const
{
    const bool here = std::ranges::any_of(sub_meshes_, [](const auto& one) { return one && one->is_single(); });
    return ranks_->largest({here ? 1.0 : 0.0}).front() > 0.0;
}

/// The largest residual of interiors in each column, over all ranks.
Point SchurStepper::interior_residual() const
{
    Point largest = Point::Zero();
    for (const auto& one : sub_meshes_)
        if (one)
            largest = largest.cwiseMax(one->residual());
    const std::vector<double> of_all = ranks_->largest({largest[0], largest[1], largest[2]});
    return {of_all[0], of_all[1], of_all[2]};
}

/// Refines the interiors until the remaining back substitution leaves no more than the tolerance, which usually holds
/// without refinement.
/// @param tolerance relative to `first`. @param first the largest residuals of interiors, by column, before the
/// solution on Γ.
/// @returns whether this was reached.
bool SchurStepper::refine_interiors(double tolerance, const Point& first, const Executor& exec)
{
    const auto is_small = [&](const Point& residual) {
        return (left_by_single * residual.array() <= tolerance * first.array()).all();
    };
    Point residual = interior_residual();
    while (!is_small(residual)) {
        refine_all(interface_.update, exec);
        const Point before = std::exchange(residual, interior_residual());
        // A refinement that does not halve the residual has come to rounding: further ones would not help.
        if (residual.maxCoeff() > 0.5 * before.maxCoeff())
            return is_small(residual);
    }
    return true;
}

/// For each coordinate, whether Γ moves along it by no more than the rounding of positions, so that the residual of
/// that coordinate has no meaning.
std::array<bool, 3> SchurStepper::at_rest(const Executor& exec) const
{
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    std::vector<double> farthest(sub_meshes_.size(), 0.0);
    for_each(exec, static_cast<Index>(sub_meshes_.size()), [&](Index s) {
        if (!is_own(s))
            return;
        const CondensedSubMesh::Vertices& own = sub_meshes_[s]->vertices();
        for (Index v = 0; v < own.n_vertices; ++v)
            farthest[s] = std::max(farthest[s], before_->row(own.local_to_global[v]).cwiseAbs().maxCoeff());
    });
    // The movement of Γ on a rank that has no vertex of Γ: less than any other, so that it does not count.
    constexpr double unknown = -1.0;
    Point moved = Point::Constant(unknown);
    if (interface_.update.size() > 0)
        moved = interface_.update.cwiseAbs().colwise().maxCoeff();
    const double position = sub_meshes_.empty() ? 0.0 : std::ranges::max(farthest);
    const std::vector<double> of_all = ranks_->largest({moved[0], moved[1], moved[2], position});
    std::array<bool, 3> rests{};
    for (std::size_t c = 0; c < 3; ++c)
        rests[c] = of_all[c] != unknown && of_all[c] <= rounding * of_all[3];
    return rests;
}

/// Solves the equation on Γ, and refines the interiors.
/// @param has_matrix whether the matrix is that of the last solution.
/// @returns `stagnated` is true also if the refinement of the interiors stagnates.
InterfaceResult SchurStepper::solve_on_interface(bool has_matrix, const IterationStop& stop, const Executor& exec)
{
    interface_.reached.setZero(equation_.copies().n_vertices(), 3);
    const Point first = interior_residual();
    // Σ S x_Γ = Σ g_Γ over the sub-meshes
    InterfaceResult result = equation_.solve(
        interface_.complements, has_matrix, interface_.condensed,
        [&](const Points& update) -> Points& { return refine_all(update, exec); },
        interface_.has_guess ? &interface_.guess : nullptr, stop, interface_.update, exec);
    // The residual of a coordinate in which Γ is at rest is rounding: it does not count.
    const std::array<bool, 3> rests = at_rest(exec);
    if (std::ranges::find(rests, true) != rests.end()) {
        double moving = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            if (!rests[c])
                moving = std::max(moving, result.residuals[static_cast<Eigen::Index>(c)]);
        result.residual = std::min(result.residual, std::max(moving, stop.tolerance));
        result.stagnated &= moving > stop.tolerance;
    }
    // Interiors may move where Γ does not. If they do not move either, no refinement makes their residuals smaller.
    const bool is_refined = !has_single() || refine_interiors(stop.tolerance, first, exec);
    if (!is_refined && std::ranges::find(rests, false) != rests.end()) {
        result.residual = std::max(result.residual, largest_ratio(interior_residual(), first));
        result.stagnated = true;
    }
    return result;
}

InterfaceResult SchurStepper::solve_equation(const IterationStop& stop, const Executor& exec)
{
    interface_.guess.swap(interface_.update);
    interface_.has_guess = std::exchange(interface_.has_update, true);
    const InterfaceResult result = solve_on_interface(has_matrix(), stop, exec);
    if (data_ == nullptr) {
        // Further solutions of a step may have factors in double precision, but the next step begins in single
        // precision.
        interface_.has_complements = keeps_matrix_;
        std::ranges::fill(changed_, 0);
        has_changed_ = false;
    }
    if (!result.stagnated || !has_single() || factors_.precision == Precision::Single)
        return result;
    // The next step begins in single precision, as that of a resumed flow does.
    interface_.has_complements = false;
    for_each_sub_mesh(exec, [&](Index s) {
        sub_meshes_[s]->condense(shared_step(), Precision::Double, workspaces_.local(), interface_.complements[s]);
    });
    return solve_on_interface(false, stop, exec);
}

void SchurStepper::set_data(const Points& data, DataSteps steps)
{
    ConvergedStepper::set_data(data, steps);
    interface_.has_update = false;
}

bool SchurStepper::can_take_columns() const
{
    return sub_meshes_.size() == 1 && filter_.is_plain() && interface_.has_complements && !has_changed_ &&
           sub_meshes_.front()->can_take_columns();
}

void SchurStepper::take_columns(Eigen::Ref<Eigen::MatrixXd> fields, int n, const Executor& exec)
{
    run_for_sub_mesh(names_.front(), [&] { sub_meshes_.front()->take_steps(time_step_, n, fields, exec); });
}

/// x_I = A_II⁻¹ (b_I - A_IΓ x_Γ)
void SchurStepper::back_substitute(Index s)
{
    sub_meshes_[s]->back_substitute(shared_step(), interface_.update, keeps_matrix_ || !filter_.is_plain(),
                                    workspaces_.local());
}

/// Calls action(i, sub-mesh, local number) for the i-th vertex, in each sub-mesh that the vertex belongs to, and marks
/// these sub-meshes as changed.
template <class Action>
void SchurStepper::change(std::span<const Index> vertices, Action&& action)
{
    if (local_vertices_of_.size() == 0)
        local_vertices_of_ = make_lists<LocalVertex>(static_cast<Index>(positions_.rows()), [&](auto&& add) {
            for (Index s = 0; s < static_cast<Index>(sub_meshes_.size()); ++s)
                for (Index v = 0; is_own(s) && v < sub_meshes_[s]->vertices().n_vertices; ++v)
                    add(sub_meshes_[s]->vertices().local_to_global[v], LocalVertex{s, v});
        });
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const LocalVertex& vertex : local_vertices_of_[vertices[i]]) {
            changed_[vertex.sub_mesh] = 1;
            has_changed_ = true;
            action(i, *sub_meshes_[vertex.sub_mesh], vertex.local);
        }
}

void SchurStepper::set_fixed(std::span<const Index> vertices, bool is_fixed)
{
    change(vertices,
           [&](std::size_t, CondensedSubMesh& sub_mesh, Index v) { sub_mesh.system().set_fixed(v, is_fixed); });
    std::vector<std::uint8_t> is_named(usize(static_cast<Index>(positions_.rows())), 0);
    for (const Index v : vertices)
        is_named[v] = 1;
    const std::vector<Index> on_interface = saved_vertices();
    for (std::size_t i = 0; i < on_interface.size(); ++i)
        if (is_named[on_interface[i]] != 0)
            equation_.set_fixed(static_cast<Index>(i), is_fixed);
}

void SchurStepper::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    change(vertices,
           [&](std::size_t i, CondensedSubMesh& sub_mesh, Index v) { sub_mesh.system().attach(v, weights[i]); });
}

void SchurStepper::weigh(const std::function<double(Index v, Index w)>& squared_difference)
{
    std::ranges::fill(changed_, 1);
    has_changed_ = true;
    for_each(run_in_parallel, static_cast<Index>(sub_meshes_.size()), [&](Index s) {
        if (!is_own(s))
            return;
        const std::vector<Index>& global = sub_meshes_[s]->vertices().local_to_global;
        sub_meshes_[s]->system().weigh([&](Index v, Index w) { return squared_difference(global[v], global[w]); });
    });
}

/// Moves vertices of V⁰ (initial_). Without effect if K and M are those of Vᵏ.
void SchurStepper::set_reference_vertices(std::span<const Index> vertices, const Points& to)
{
    if (initial_.rows() == 0)
        return;
    move_rows(vertices, to, initial_);
    // Marks the sub-meshes that have these vertices as changed.
    change(vertices, [](std::size_t, CondensedSubMesh&, Index) {});
    for_each(run_in_parallel, static_cast<Index>(sub_meshes_.size()), [&](Index s) {
        if (changed_[s] != 0)
            sub_meshes_[s]->system().set_reference(rows_of(initial_, sub_meshes_[s]->vertices().local_to_global));
    });
}

void SchurStepper::save(StepMemory& memory) const
{
    ConvergedStepper::save(memory);
    memory.arrays = {interface_.update};
}

std::vector<Index> SchurStepper::saved_vertices() const
{
    const InterfaceCopies& copies = equation_.copies();
    std::vector<Index> vertices(usize(copies.n_vertices()));
    for (Index s = 0; s < copies.n_sub_meshes(); ++s) {
        if (!is_own(s))
            continue;
        const NeumannSystem& system = sub_meshes_[s]->system();
        for (Index i = 0; i < system.n_interface(); ++i)
            vertices[copies.vertex[copies.offsets[s] + i]] =
                sub_meshes_[s]->vertices().local_to_global[system.unknowns()[system.n_interior() + i]];
    }
    return vertices;
}

void SchurStepper::restore_further(StepMemoryReader& memory)
{
    interface_.update = memory.array(equation_.copies().n_vertices());
    interface_.has_update = true;
}

void SchurStepper::report_to(FlowReport& report) const
{
    report.cut.interface_vertices = interface_.n_vertices;
    report.resources.live_factors = factors_.plan.n_live();
    report.resources.factor_memory_bytes = factors_.recomputed->bytes();
    for (const auto& one : sub_meshes_) {
        if (!one)
            continue;
        report.cut.sub_meshes.push_back({.faces = static_cast<Index>(one->vertices().faces.size()),
                                         .vertices = one->vertices().n_vertices,
                                         .factorisation = Factorisation::Own});
        report.resources.single_factors += one->is_single() ? 1 : 0;
        if (one->is_kept())
            report.resources.factor_memory_bytes +=
                one->is_single() ? one->system().factor_bytes<float>() : one->system().factor_bytes<double>();
    }
    describe_steps(report);
}

}  // namespace seamflow
