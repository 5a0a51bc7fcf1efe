#include "engine/steppers/condensed_sub_mesh.h"

#include <utility>

#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"

namespace seamflow {

CondensedSubMesh::CondensedSubMesh(Vertices vertices, std::unique_ptr<NeumannSystem> system,
                                   std::span<const Index> on_interface, Index first_copy, PhaseSeconds& seconds)
    : vertices_(std::move(vertices))
    , system_(std::move(system))
    , on_interface_(on_interface)
    , first_copy_(first_copy)
    , seconds_(&seconds)
{
}

void CondensedSubMesh::use_memory(FactorMemory& memory, bool is_kept)
{
    memory_ = &memory;
    is_kept_ = is_kept;
}

/// Sets the increments Vᵏ⁺¹ - Vᵏ, of the step and in the workspace, to 0.
void CondensedSubMesh::begin_increments(const CondensedStep& step, SolverWorkspace& workspace) const
{
    for (const Index v : interior())
        step.positions.row(global(v)).setZero();
    set_rows(workspace.increments, vertices_.n_vertices);
    workspace.increments.setZero();
}

/// Copies the increments Vᵏ⁺¹ - Vᵏ that the step has reached so far to the workspace.
void CondensedSubMesh::fetch_increments(const CondensedStep& step, SolverWorkspace& workspace) const
{
    Points& increments = workspace.increments;
    set_rows(increments, vertices_.n_vertices);
    increments.setZero();
    for (const Index v : interior())
        increments.row(v) = step.positions.row(global(v));
    for (Index i = 0; i < system_->n_interface(); ++i)
        increments.row(system_->unknowns()[system_->n_interior() + i]) = step.reached.row(on_interface_[i]);
}

/// Assembles the equations at the increments in the workspace.
NeumannSystem::Assembled CondensedSubMesh::assemble(const CondensedStep& step, SolverWorkspace& workspace) const
{
    const auto own = std::span(vertices_.local_to_global).first(usize(vertices_.n_vertices));
    const Points& positions = gather_rows(own, step.before, workspace.positions);
    const Points* const data = step.data != nullptr ? &gather_rows(own, *step.data, workspace.data) : nullptr;
    return system_->assemble(positions, workspace.increments, step.time_step, workspace, data);
}

/// Factorises the equations, and condenses them with this factor.
/// @returns the factor, which back_substitute needs.
NeumannSystem::Factor CondensedSubMesh::factorise(const CondensedStep& step, SolverWorkspace& workspace)
{
    Stopwatch watch;
    const NeumannSystem::Assembled equations = assemble(step, workspace);
    seconds_->assemble += watch.lap();
    std::optional<NeumannSystem::Factor> factor = system_->factorise(equations, precision_, *memory_, workspace.ldl);
    precision_ = factor && factor->is_single() ? Precision::Single : Precision::Double;
    // There is no factor if single precision would lose too many digits: precision_ is now double.
    if (!factor)
        factor = system_->factorise(equations, precision_, *memory_, workspace.ldl);
    seconds_->factorise += watch.lap();
    eliminate(step, equations, *factor);
    seconds_->solve += watch.lap();
    return *std::move(factor);
}

/// Condenses the residual to the sub-mesh's copies of Γ, and records the largest residual of the interior.
void CondensedSubMesh::eliminate(const CondensedStep& step, const NeumannSystem::Assembled& equations,
                                 NeumannSystem::Factor& factor)
{
    residual_.setZero();
    for (const Index v : interior())
        residual_ = residual_.cwiseMax(equations.residual.row(v).cwiseAbs());
    // g_Γ = r_Γ - A_ΓI A_II⁻¹ r_I
    system_->condense(equations, factor, step.condensed.middleRows(first_copy_, system_->n_interface()));
}

void CondensedSubMesh::condense(const CondensedStep& step, Precision precision, SolverWorkspace& workspace,
                                DenseFactor& complement)
{
    factor_.reset();
    precision_ = precision;
    begin_increments(step, workspace);
    NeumannSystem::Factor factor = factorise(step, workspace);
    system_->take_schur_complement(factor, workspace.ldl, complement);
    if (is_kept_)
        factor_ = std::move(factor);
}

void CondensedSubMesh::condense_again(const CondensedStep& step, SolverWorkspace& workspace)
{
    begin_increments(step, workspace);
    if (!factor_) {
        factorise(step, workspace);
        return;
    }
    Stopwatch watch;
    eliminate(step, assemble(step, workspace), *factor_);
    seconds_->solve += watch.lap();
}

/// Takes the factor that the last condensation has stored, or recomputes it.
NeumannSystem::Factor CondensedSubMesh::take_factor(const CondensedStep& step, SolverWorkspace& workspace)
{
    if (factor_)
        return *std::exchange(factor_, std::nullopt);
    fetch_increments(step, workspace);
    return factorise(step, workspace);
}

/// Solves for the interior at an update of Γ.
/// @param factor as condensation has left it. @param workspace receives the increments.
void CondensedSubMesh::substitute(const CondensedStep& step, NeumannSystem::Factor& factor, const Points& update,
                                  SolverWorkspace& workspace) const
{
    fetch_increments(step, workspace);
    Points change(system_->n_interface(), 3);
    for (Index i = 0; i < system_->n_interface(); ++i) {
        change.row(i) = update.row(on_interface_[i]) - step.reached.row(on_interface_[i]);
        workspace.increments.row(system_->unknowns()[system_->n_interior() + i]) = update.row(on_interface_[i]);
    }
    // x_I = A_II⁻¹ (r_I - A_IΓ x_Γ)
    system_->back_substitute(factor, change, workspace.increments);
}

void CondensedSubMesh::refine(const CondensedStep& step, const Points& update, SolverWorkspace& workspace)
{
    NeumannSystem::Factor factor = take_factor(step, workspace);
    substitute(step, factor, update, workspace);
    for (const Index v : interior())
        step.positions.row(global(v)) = workspace.increments.row(v);
    eliminate(step, assemble(step, workspace), factor);
    if (is_kept_)
        factor_ = std::move(factor);
}

void CondensedSubMesh::back_substitute(const CondensedStep& step, const Points& update, bool keeps_factor,
                                       SolverWorkspace& workspace)
{
    NeumannSystem::Factor factor = take_factor(step, workspace);
    Stopwatch watch;
    substitute(step, factor, update, workspace);
    // For other data the unknown is the result itself, which begins at 0; otherwise it is Vᵏ⁺¹ - Vᵏ.
    for (const Index v : system_->unknowns())
        if (vertices_.owned[v] != 0)
            step.positions.row(global(v)) = step.data != nullptr
                                                ? Point(workspace.increments.row(v))
                                                : step.before.row(global(v)) + workspace.increments.row(v);
    if (keeps_factor && is_kept_)
        factor_ = std::move(factor);
    seconds_->solve += watch.lap();
}

bool CondensedSubMesh::can_take_columns() const
{
    return factor_ && system_->can_take_columns(*factor_);
}

void CondensedSubMesh::take_steps(double time_step, int n, Eigen::Ref<Eigen::MatrixXd> fields,
                                  const Executor& exec) const
{
    system_->take_steps(*factor_, time_step, n, vertices_.local_to_global, fields, exec);
}

}  // namespace seamflow
