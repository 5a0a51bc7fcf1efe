#include "solvers/systems/general_system.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "partition/errors.h"
#include "solvers/systems/messages.h"

namespace seamflow {

GeneralSystem::GeneralSystem(const SubMesh& sub_mesh, Laplacian laplacian,
                             std::unique_ptr<TransmissionCondition> condition, Factorisation factorisation)
    : sub_mesh_(&sub_mesh)
    , condition_(std::move(condition))
    , laplacian_(make_assembler(laplacian, faces_of(sub_mesh)))
    , right_hand_side_(sub_mesh.n_vertices, 3)
    , solution_(sub_mesh.n_vertices, 3)
{
    make_rows();
    const auto is_laplacian = [&](const MatrixEntry& entry) { return row_of_[entry.row] == Row::Laplacian; };
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
    pattern_ = std::make_unique<SparsePattern>(make_pattern(sub_mesh.n_vertices, entries));

    const Index unread = pattern_->n_entries();
    laplacian_slots_.reserve(laplacian_entries.size());
    for (const MatrixEntry& entry : laplacian_entries)
        laplacian_slots_.push_back(is_laplacian(entry) ? pattern_->slot(entry) : unread);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        diagonal_slots_.push_back(pattern_->slot({v, v}));
    for (Index i = 0; i < interface_columns.size(); ++i)
        for (const Index column : interface_columns[i])
            interface_slots_.push_back(pattern_->slot({column, sub_mesh.interface.vertices[i]}));
    values_.resize(at(unread) + 1);
    solver_ = make_general_solver(*pattern_, factorisation);
}

void GeneralSystem::make_rows()
{
    row_of_.assign(sub_mesh_->n_vertices, Row::Laplacian);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] != 0)
            row_of_[v] = Row::Fixed;
    for (const Index v : sub_mesh_->interface.vertices)
        row_of_[v] = Row::Interface;
}

void GeneralSystem::assemble(const Points& positions, const Points& other_side, double time_step, double p,
                             std::span<const InterfaceRole> roles, SolverWorkspace&)
{
    roles_.assign(roles.begin(), roles.end());
    std::fill(values_.begin(), values_.end(), 0.0);
    laplacian_->add(positions, time_step, laplacian_slots_, values_);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v) {
        if (row_of_[v] != Row::Interface)
            values_[diagonal_slots_[v]] += 1.0;
        right_hand_side_.row(v) = positions.row(v);
    }
    condition_->begin_step(positions, other_side, time_step, p);
    assemble_interface(positions, other_side);
}

void GeneralSystem::assemble_interface(const Points& positions, const Points& other_side)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i) {
        const auto begin = at(condition_->columns().offsets[i]);
        if (roles_[i] == InterfaceRole::Follows) {
            values_[diagonal_slots_[vertices[i]]] = 1.0;
            continue;
        }
        row_.resize(condition_->columns()[i].size());
        condition_->left_hand_side(i, positions, row_);
        right_hand_side_.row(vertices[i]) = condition_->right_hand_side(i, positions, other_side);
        for (std::size_t k = 0; k < row_.size(); ++k)
            values_[interface_slots_[begin + k]] = row_[k];
    }
}

void GeneralSystem::factorise(SolverWorkspace& workspace)
{
    const auto values = std::span<const double>(values_).first(values_.size() - 1);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError(equations_not_finite);
    if (!solver_->factorise(values, workspace))
        throw ComputationError(system_singular);
    n_nearly_singular_ += solver_->is_nearly_singular() ? 1 : 0;
}

void GeneralSystem::use_other_side(const Points& positions, const Points& other_side)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (Index i = 0; i < static_cast<Index>(vertices.size()); ++i)
        if (roles_[i] == InterfaceRole::Leads)
            right_hand_side_.row(vertices[i]) = condition_->right_hand_side(i, positions, other_side);
}

void GeneralSystem::predict(const Points& positions, Points& prediction, SolverWorkspace& workspace)
{
    solve_with(positions, prediction, workspace);
}

void GeneralSystem::solve(const Points&, Points& solution, SolverWorkspace& workspace)
{
    solve_with(solution, solution, workspace);
    solver_->free_factor(*workspace.factors);
}

/// @param given #local by 3: Vᵏ⁺¹, or what stands for it, where the sub-mesh follows; may be the solution itself.
void GeneralSystem::solve_with(const Points& given, Points& solution, SolverWorkspace& workspace)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            right_hand_side_.row(vertices[i]) = given.row(vertices[i]);
    solver_->solve(right_hand_side_, solution_, workspace);
    if (!solution_.allFinite())
        throw ComputationError(result_not_finite);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        solution.row(v) = row_of_[v] == Row::Fixed ? right_hand_side_.row(v) : solution_.row(v);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (roles_[i] == InterfaceRole::Follows)
            solution.row(vertices[i]) = right_hand_side_.row(vertices[i]);
}

}  // namespace seamflow
