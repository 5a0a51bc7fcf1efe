#include "solvers/systems/general_system.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "solvers/direct/make_solver.h"
#include "solvers/systems/checks.h"

namespace seamflow {

GeneralSystem::GeneralSystem(SystemParts parts, std::unique_ptr<TransmissionCondition> condition)
    : sub_mesh_(&parts.sub_mesh)
    , twin_(std::move(parts.twin))
    , condition_(std::move(condition))
    , right_hand_side_(sub_mesh_->n_vertices, 3)
    , solution_(sub_mesh_->n_vertices, 3)
{
    const SubMesh& sub_mesh = *sub_mesh_;
    make_rows();
    screening_ = make_screening(parts.terms, std::span(sub_mesh.local_to_global).first(usize(sub_mesh.n_vertices)));
    const auto is_laplacian = [&](const MatrixEntry& entry) { return row_of_[entry.row] == Row::Laplacian; };
    const Points first =
        parts.terms.keeps_stiffness ? rows_of(*parts.terms.initial, sub_mesh.local_to_global) : Points(0, 3);
    laplacian_ = make_assembler(parts.laplacian, {sub_mesh.face_vertices, {}, twin_, sub_mesh.n_vertices},
                                parts.terms.keeps_stiffness ? &first : nullptr);
    const std::vector<MatrixEntry> laplacian_entries = laplacian_->entries();

    std::vector<MatrixEntry> entries;
    entries.reserve(laplacian_entries.size());
    std::copy_if(laplacian_entries.begin(), laplacian_entries.end(), std::back_inserter(entries), is_laplacian);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        entries.push_back({v, v});
    const IndexLists& interface_columns = condition_->columns();
    for (Index i = 0; i < interface_columns.size(); ++i)
        for (const Index column : interface_columns[i])
            entries.push_back({column, sub_mesh.interface.vertices[i]});
    pattern_ = make_pattern(sub_mesh.n_vertices, entries);

    slots_.reserve(laplacian_entries.size());
    for (const MatrixEntry& entry : laplacian_entries)
        slots_.push_back(is_laplacian(entry) ? pattern_.slot(entry) : pattern_.n_entries());
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        diagonal_slots_.push_back(pattern_.slot({v, v}));
    for (Index i = 0; i < interface_columns.size(); ++i)
        for (const Index column : interface_columns[i])
            interface_slots_.push_back(pattern_.slot({column, sub_mesh.interface.vertices[i]}));
    values_.resize(pattern_.rows.size() + 1);
    solver_ = make_general_solver(pattern_, parts.factorisation);
}

/// Fills row_of_.
void GeneralSystem::make_rows()
{
    row_of_.assign(sub_mesh_->n_vertices, Row::Laplacian);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] != 0)
            row_of_[v] = Row::Fixed;
    for (const Index v : sub_mesh_->interface.vertices)
        row_of_[v] = Row::Interface;
}

SubMeshSystem::Assembled GeneralSystem::assemble(const Points& positions, const Points& other_side, double time_step,
                                                 double p, std::span<const InterfaceRole> roles, SolverWorkspace&)
{
    time_step_ = time_step;
    pulls_ = screening_.exists();
    roles_.assign(roles.begin(), roles.end());
    // (I + dt Δ + dt w) Vᵏ⁺¹ = Vᵏ + dt w V⁰, except on Γ and where vertices are fixed
    std::fill(values_.begin(), values_.end(), 0.0);
    laplacian_->add(positions, time_step, slots_, values_);
    // A vertex with step scale s takes a step of s dt.
    for (std::size_t slot = 0; !screening_.strengths.empty() && slot < pattern_.rows.size(); ++slot)
        values_[slot] *= screening_.strengths[usize(pattern_.rows[slot])];
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v) {
        if (row_of_[v] != Row::Interface)
            diagonal(v) += 1.0;
        right_hand_side_.row(v) = positions.row(v);
        if (row_of_[v] == Row::Laplacian && screening_.exists()) {
            diagonal(v) += time_step * screening_.weight(v);
            right_hand_side_.row(v) += pull(v);
        }
    }
    condition_->begin_step(positions, other_side, time_step, p);
    assemble_interface(positions, other_side);
    return {std::span(values_).first(pattern_.rows.size())};
}

/// dt w V⁰: the contribution of the attachment to the right-hand side.
Point GeneralSystem::pull(Index v) const
{
    return pulls_ ? Point(time_step_ * screening_.weight(v) * screening_.initial.row(v)) : Point::Zero();
}

/// Fills in the rows on Γ: the condition where the sub-mesh leads, the identity where it follows.
void GeneralSystem::assemble_interface(const Points& positions, const Points& other_side)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i) {
        const auto begin = usize(condition_->columns().offsets[i]);
        if (roles_[i] == InterfaceRole::Follows) {
            diagonal(vertices[i]) = 1.0;
            continue;
        }
        row_.resize(condition_->columns()[i].size());
        condition_->left_hand_side(i, positions, row_);
        right_hand_side_.row(vertices[i]) = condition_->right_hand_side(i, positions, other_side) + pull(vertices[i]);
        for (std::size_t k = 0; k < row_.size(); ++k)
            values_[interface_slots_[begin + k]] = row_[k];
        diagonal(vertices[i]) += time_step_ * screening_.weight(vertices[i]);
    }
}

SubMeshSystem::Factor GeneralSystem::factorise(const Assembled& equations, FactorMemory& memory,
                                               SolverWorkspace& workspace)
{
    require_finite_equations(equations.matrix);
    Factor factor = require_factor(solver_->factorise(equations.matrix, memory, workspace));
    n_nearly_singular_ += factor.is_nearly_singular() ? 1 : 0;
    return factor;
}

void GeneralSystem::use_data(const Points& data)
{
    pulls_ = false;
    right_hand_side_ = data.topRows(sub_mesh_->n_vertices);
    use_other_side(data, data);
}

void GeneralSystem::use_other_side(const Points& positions, const Points& other_side)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i)
        if (roles_[i] == InterfaceRole::Leads)
            right_hand_side_.row(vertices[i]) =
                condition_->right_hand_side(i, positions, other_side) + pull(vertices[i]);
}

void GeneralSystem::solve(const Factor& factor, const Points&, Points& solution, SolverWorkspace& workspace)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            right_hand_side_.row(vertices[i]) = solution.row(vertices[i]);
    factor.solve(right_hand_side_, solution_, workspace);
    require_finite_result(solution_.allFinite());
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        solution.row(v) = row_of_[v] == Row::Fixed ? right_hand_side_.row(v) : solution_.row(v);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            solution.row(vertices[i]) = right_hand_side_.row(vertices[i]);
}

}  // namespace seamflow
