#include "solvers/systems/symmetric_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partition/errors.h"
#include "solvers/conditions/remainder.h"
#include "solvers/direct/columns.h"
#include "solvers/sparse/elimination_order.h"
#include "solvers/systems/messages.h"
#include "solvers/systems/upper_pattern.h"

namespace seamflow {

SymmetricSystem::SymmetricSystem(const SubMesh& sub_mesh, Laplacian laplacian, SymmetricRows rows,
                                 Factorisation factorisation, SolverWorkspace& workspace)
    : sub_mesh_(&sub_mesh)
    , laplacian_(make_symmetric_laplacian(laplacian, {sub_mesh.face_vertices, sub_mesh.interface.halo_faces,
                                                      sub_mesh.twin, sub_mesh.n_vertices + sub_mesh.n_halo}))
{
    std::vector<Index> unknown_of;
    number_unknowns(rows, unknown_of);
    const std::vector<VertexPair> pairs = laplacian_->pairs();
    EliminationTree tree;
    SparsePattern upper = list_entries(pairs, unknown_of, tree);
    column_offsets_ = upper.column_offsets;
    list_couplings(pairs, unknown_of);
    if (rows == SymmetricRows::Yielding)
        list_interface(upper, unknown_of);
    mass_.resize(vertex_of_.size());
    solver_ = make_symmetric_solver(std::move(upper), factorisation, workspace, tree);
}

/// In the order of the vertices.
/// @param unknown_of receives one entry per own vertex, -1 where it is none.
void SymmetricSystem::number_unknowns(SymmetricRows rows, std::vector<Index>& unknown_of)
{
    unknown_of.assign(sub_mesh_->n_vertices, 0);
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] != 0)
            unknown_of[v] = -1;
    if (rows == SymmetricRows::None)
        for (const Index v : sub_mesh_->interface.vertices)
            unknown_of[v] = -1;
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (unknown_of[v] == 0) {
            unknown_of[v] = static_cast<Index>(vertex_of_.size());
            vertex_of_.push_back(v);
        }
}

/// Renumbers the unknowns in the order of elimination.
SparsePattern SymmetricSystem::list_entries(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of,
                                            EliminationTree& tree)
{
    const auto n = static_cast<Index>(vertex_of_.size());
    const PairsOfUnknowns pairs_of = pairs_of_unknowns(pairs, unknown_of, n);
    Elimination elimination = eliminate(neighbours_of(pairs_of));
    tree = std::move(elimination.tree);
    const std::vector<Index>& order = elimination.order;
    std::vector<Index> vertex_of(n);
    std::transform(order.begin(), order.end(), vertex_of.begin(), [&](Index u) { return vertex_of_[u]; });
    vertex_of_ = std::move(vertex_of);
    for (Index u = 0; u < n; ++u)
        unknown_of[vertex_of_[u]] = u;
    UpperPattern upper = upper_pattern(pairs_of, order);
    slots_ = std::move(upper.slots);
    return std::move(upper.pattern);
}

/// What is no entry of the matrix; what is beyond Γ by the vertices of Γ.
void SymmetricSystem::list_couplings(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of)
{
    const auto is_unknown = [&](Index v) { return v < sub_mesh_->n_vertices && unknown_of[v] >= 0; };
    const auto unknown_first = [&](VertexPair pair) {
        return is_unknown(pair.first) ? pair : VertexPair{pair.second, pair.first};
    };
    std::vector<std::size_t> at_fixed;
    std::vector<std::pair<Index, std::size_t>> at_beyond;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (slots_[i] >= 0)
            continue;
        const auto [a, b] = unknown_first(pairs[i]);
        if (!is_unknown(a))
            continue;
        if (b < sub_mesh_->n_vertices)
            at_fixed.push_back(i);
        else
            at_beyond.emplace_back(a, i);
    }
    Index slot = n_entries();
    for (const std::size_t i : at_fixed) {
        const auto [a, b] = unknown_first(pairs[i]);
        slots_[i] = slot++;
        fixed_.push_back({unknown_of[a], b, 0.0});
    }
    std::sort(at_beyond.begin(), at_beyond.end());
    for (const auto& [a, i] : at_beyond) {
        slots_[i] = slot++;
        beyond_.push_back({unknown_of[a], unknown_first(pairs[i]).second, 0.0});
    }
    std::replace(slots_.begin(), slots_.end(), Index{-1}, slot);
}

/// What belongs to each vertex of Γ, whose roles change.
void SymmetricSystem::list_interface(const SparsePattern& upper, const std::vector<Index>& unknown_of)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    interface_rows_.resize(vertices.size());
    std::vector<std::vector<InterfaceEntry>> entries(vertices.size());
    std::vector<Index> interface_index(vertex_of_.size(), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        interface_unknowns_.push_back(unknown_of[vertices[i]]);
        interface_index[interface_unknowns_[i]] = static_cast<Index>(i);
    }
    for (Index column = 0; column < upper.n(); ++column)
        for (Index slot = upper.column_offsets[column]; slot < upper.column_offsets[column + 1]; ++slot) {
            const Index row = upper.rows[slot];
            if (row == column)
                continue;
            if (interface_index[row] >= 0)
                entries[interface_index[row]].push_back({slot, column});
            if (interface_index[column] >= 0)
                entries[interface_index[column]].push_back({slot, row});
        }
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        interface_offsets_.push_back(static_cast<Index>(interface_entries_.size()));
        interface_entries_.insert(interface_entries_.end(), entries[i].begin(), entries[i].end());
        beyond_offsets_.push_back(static_cast<Index>(beyond));
        while (beyond < beyond_.size() && beyond_[beyond].unknown == interface_unknowns_[i])
            ++beyond;
    }
    interface_offsets_.push_back(static_cast<Index>(interface_entries_.size()));
    beyond_offsets_.push_back(static_cast<Index>(beyond));
    held_.reserve(interface_entries_.size());
}

void SymmetricSystem::assemble(const Points& positions, const Points& other_side, double time_step, double,
                               std::span<const InterfaceRole> roles, SolverWorkspace& workspace)
{
    const auto n_matrix = at(n_entries());
    auto& values = workspace.values;
    values.assign(n_matrix + fixed_.size() + beyond_.size() + 1, 0.0);
    workspace.diagonal.resize(sub_mesh_->n_vertices + sub_mesh_->n_halo);
    workspace.mass.resize(workspace.diagonal.size());
    laplacian_->assemble(positions, time_step, slots_, values, workspace.diagonal, workspace.mass);

    for (std::size_t u = 0; u < vertex_of_.size(); ++u) {
        mass_[u] = workspace.mass[vertex_of_[u]];
        values[diagonal_slot(column_offsets_, static_cast<Index>(u))] = mass_[u] + workspace.diagonal[vertex_of_[u]];
    }
    for (std::size_t c = 0; c < fixed_.size(); ++c)
        fixed_[c].value = values[n_matrix + c];
    for (std::size_t c = 0; c < beyond_.size(); ++c)
        beyond_[c].value = values[n_matrix + fixed_.size() + c];

    held_.clear();
    for (std::size_t i = 0; i < interface_rows_.size(); ++i) {
        interface_rows_[i].role = roles[i];
        if (roles[i] == InterfaceRole::Follows)
            hold(i, values);
        else
            yield(i, positions, time_step, workspace.diagonal[sub_mesh_->interface.vertices[i]], values);
    }
    use_other_side(positions, other_side);
}

/// Moves the coefficients at a vertex of Γ that is known in this step out of the matrix. Of two such vertices the
/// second finds nothing any more.
void SymmetricSystem::hold(std::size_t i, std::span<double> values)
{
    for (Index e = interface_offsets_[i]; e < interface_offsets_[i + 1]; ++e) {
        const InterfaceEntry& entry = interface_entries_[e];
        held_.push_back({entry.unknown, sub_mesh_->interface.vertices[i], values[entry.slot]});
        values[entry.slot] = 0.0;
    }
    values[diagonal_slot(column_offsets_, interface_unknowns_[i])] = 1.0;
}

/// Takes from the diagonal what the other side yields; nothing where too little would remain.
/// @param diagonal dt K_vv.
void SymmetricSystem::yield(std::size_t i, const Points& positions, double time_step, double diagonal,
                            std::span<double> values)
{
    const Index v = sub_mesh_->interface.vertices[i];
    double yield = 0.0;
    for (Index c = beyond_offsets_[i]; c < beyond_offsets_[i + 1]; ++c)
        yield += beyond_[c].value * remainder_between(positions, v, beyond_[c].vertex, time_step);
    interface_rows_[i].yield = diagonal + yield >= 0.0 ? yield : 0.0;
    values[diagonal_slot(column_offsets_, interface_unknowns_[i])] += interface_rows_[i].yield;
}

void SymmetricSystem::use_other_side(const Points&, const Points& other_side)
{
    for (std::size_t i = 0; i < interface_rows_.size(); ++i) {
        InterfaceRow& row = interface_rows_[i];
        row.beyond = Point::Zero();
        if (row.role == InterfaceRole::Follows)
            continue;
        for (Index c = beyond_offsets_[i]; c < beyond_offsets_[i + 1]; ++c)
            row.beyond -= beyond_[c].value * other_side.row(beyond_[c].vertex);
    }
}

void SymmetricSystem::factorise(SolverWorkspace& workspace)
{
    const auto values = std::span<double>(workspace.values).first(n_entries());
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError(equations_not_finite);
    if (vertex_of_.empty() || solver_->factorise(values, workspace))
        return;
    stop_yielding(values);
    if (!solver_->factorise(values, workspace))
        throw ComputationError(system_singular);
}

/// Without yielding, all rows are those of M + dt K, which is positive definite.
void SymmetricSystem::stop_yielding(std::span<double> values)
{
    for (std::size_t i = 0; i < interface_rows_.size(); ++i) {
        if (interface_rows_[i].role == InterfaceRole::Follows)
            continue;
        values[diagonal_slot(column_offsets_, interface_unknowns_[i])] -= interface_rows_[i].yield;
        interface_rows_[i].yield = 0.0;
    }
}

void SymmetricSystem::predict(const Points& positions, Points& prediction, SolverWorkspace& workspace)
{
    for (const Index v : sub_mesh_->interface.vertices)
        prediction.row(v) = positions.row(v);
    solve_with(positions, prediction, workspace);
}

void SymmetricSystem::solve(const Points& positions, Points& solution, SolverWorkspace& workspace)
{
    solve_with(positions, solution, workspace);
    solver_->free_factor(*workspace.factors);
}

/// @param solution in: what is known of Γ; out: everything.
void SymmetricSystem::solve_with(const Points& positions, Points& solution, SolverWorkspace& workspace)
{
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] != 0)
            solution.row(v) = positions.row(v);
    if (vertex_of_.empty())
        return;
    fill_right_hand_side(positions, solution, workspace.right_hand_side);
    solver_->solve(workspace.right_hand_side, workspace.solution, workspace);
    if (!workspace.solution.allFinite())
        throw ComputationError(result_not_finite);
    for (std::size_t u = 0; u < vertex_of_.size(); ++u)
        solution.row(vertex_of_[u]) = workspace.solution.row(static_cast<Eigen::Index>(u));
    for (std::size_t i = 0; i < interface_rows_.size(); ++i) {
        const Index v = sub_mesh_->interface.vertices[i];
        if (interface_rows_[i].role == InterfaceRole::Follows)
            solution.row(v) = workspace.right_hand_side.row(interface_unknowns_[i]);
    }
}

void SymmetricSystem::fill_right_hand_side(const Points& positions, const Points& known, Columns& right) const
{
    set_rows(right, static_cast<Eigen::Index>(vertex_of_.size()));
    for (std::size_t u = 0; u < vertex_of_.size(); ++u)
        right.row(static_cast<Eigen::Index>(u)) = mass_[u] * positions.row(vertex_of_[u]);
    for (const auto* couplings : {&fixed_, &held_})
        for (const Coupling& coupling : *couplings)
            right.row(coupling.unknown) -= coupling.value * known.row(coupling.vertex);
    for (std::size_t i = 0; i < interface_rows_.size(); ++i) {
        const Index v = sub_mesh_->interface.vertices[i];
        if (interface_rows_[i].role == InterfaceRole::Follows)
            right.row(interface_unknowns_[i]) = known.row(v);
        else
            right.row(interface_unknowns_[i]) +=
                interface_rows_[i].beyond + interface_rows_[i].yield * positions.row(v);
    }
}

}  // namespace seamflow
