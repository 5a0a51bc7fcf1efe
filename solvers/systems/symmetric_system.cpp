#include "solvers/systems/symmetric_system.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "solvers/conditions/remainder.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/make_solver.h"
#include "solvers/sparse/elimination_ordering.h"
#include "solvers/systems/checks.h"

namespace seamflow {

SymmetricSystem::SymmetricSystem(const SystemParts& parts, SymmetricRows rows, SolverWorkspace& workspace)
    : sub_mesh_(&parts.sub_mesh)
    , matrix_(make_symmetric_matrix(*sub_mesh_, parts.laplacian,
                                    {sub_mesh_->face_vertices, sub_mesh_->interface.halo_faces, parts.twin,
                                     sub_mesh_->n_vertices + sub_mesh_->n_halo},
                                    parts.terms))
{
    std::vector<std::uint8_t> is_known = sub_mesh_->fixed;
    for (const Index v : rows == SymmetricRows::Dirichlet ? sub_mesh_->interface.vertices : std::vector<Index>())
        is_known[v] = 1;
    const std::vector<VertexPair> pairs = matrix_.laplacian->pairs();
    std::vector<Index> unknown_of = matrix_.number_unknowns(pairs, is_known);
    EliminationTree tree;
    SparsePattern upper = order_unknowns(pairs, unknown_of, tree);
    matrix_.column_offsets = upper.column_offsets;
    list_couplings(pairs, unknown_of);
    if (rows == SymmetricRows::Transmission)
        list_interface(upper, unknown_of);
    solver_ =
        make_symmetric_solver(std::move(upper), parts.factorisation, workspace, tree, parts.exec, matrix_.pivots());
}

/// Renumbers the unknowns in the elimination ordering, also those of matrix_, and sets matrix_.slots.
/// @param unknown_of renumbered. @param tree receives the elimination tree.
/// @returns the pattern of the upper triangle.
SparsePattern SymmetricSystem::order_unknowns(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of,
                                              EliminationTree& tree)
{
    const PairsOfUnknowns pairs_of = pairs_of_unknowns(pairs, unknown_of, matrix_.n());
    EliminationOrdering elimination = order_elimination(neighbours_of(pairs_of));
    tree = std::move(elimination.tree);
    matrix_.reorder(elimination.order);
    for (Index u = 0; u < matrix_.n(); ++u)
        unknown_of[matrix_.vertex_of[u]] = u;
    UpperPattern upper = upper_pattern(pairs_of, elimination.order);
    matrix_.slots = std::move(upper.slots);
    return std::move(upper.pattern);
}

/// Lists the couplings, which are the coefficients in rows of unknowns that are not entries of the matrix: first those
/// at fixed vertices, then those of vertices of Γ at vertices beyond Γ, in the order of the vertices of Γ.
void SymmetricSystem::list_couplings(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of)
{
    const auto is_unknown = [&](Index v) { return unknown_of[v] >= 0; };
    const auto unknown_first = [&](VertexPair pair) {
        return is_unknown(pair.first) ? pair : VertexPair{pair.second, pair.first};
    };
    std::vector<std::tuple<bool, Index, std::size_t>> couplings;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [a, b] = unknown_first(pairs[i]);
        if (matrix_.slots[i] >= 0 || !is_unknown(a))
            continue;
        const bool is_beyond = b >= sub_mesh_->n_vertices;
        couplings.emplace_back(is_beyond, is_beyond ? a : 0, i);
    }
    std::ranges::sort(couplings);
    Index slot = matrix_.n_entries();
    for (const auto& [is_beyond, of_vertex, i] : couplings) {
        const auto [a, b] = unknown_first(pairs[i]);
        matrix_.slots[i] = slot++;
        (is_beyond ? beyond_ : fixed_).push_back({unknown_of[a], b, 0.0});
    }
    std::replace(matrix_.slots.begin(), matrix_.slots.end(), Index{-1}, slot);
}

/// Lists the entries in the row of each vertex of Γ. They move to the right-hand side in steps in which the sub-mesh
/// follows there.
void SymmetricSystem::list_interface(const SparsePattern& upper, const std::vector<Index>& unknown_of)
{
    const auto& vertices = sub_mesh_->interface.vertices;
    std::vector<Index> interface_index(matrix_.vertex_of.size(), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        interface_index[unknown_of[vertices[i]]] = static_cast<Index>(i);
    Lists<InterfaceEntry> entries = make_lists<InterfaceEntry>(static_cast<Index>(vertices.size()), [&](auto&& add) {
        for (Index column = 0; column < upper.n(); ++column)
            for (Index slot = upper.column_offsets[column]; slot < upper.column_offsets[column + 1]; ++slot) {
                const Index row = upper.rows[slot];
                if (row == column)
                    continue;
                if (interface_index[row] >= 0)
                    add(interface_index[row], {slot, column, 0.0});
                if (interface_index[column] >= 0)
                    add(interface_index[column], {slot, row, 0.0});
            }
    });
    entries_ = std::move(entries.values);
    Index beyond = 0;
    rows_.reserve(vertices.size() + 1);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        rows_.push_back({unknown_of[vertices[i]], entries.offsets[i], beyond});
        while (usize(beyond) < beyond_.size() && beyond_[beyond].unknown == rows_[i].unknown)
            ++beyond;
    }
    rows_.push_back({-1, entries.offsets.back(), beyond});
}

SubMeshSystem::Assembled SymmetricSystem::assemble(const Points& positions, const Points& other_side, double time_step,
                                                   double, std::span<const InterfaceRole> roles,
                                                   SolverWorkspace& workspace)
{
    // (M + dt K + dt M w) Vᵏ⁺¹ = M Vᵏ + dt M w V⁰
    const std::span<double> values = matrix_.fill(positions, time_step, fixed_.size() + beyond_.size(), workspace);
    const double* further = values.data() + matrix_.n_entries();
    for (auto* couplings : {&fixed_, &beyond_})
        for (Coupling& coupling : *couplings)
            coupling.value = *further++;
    mass_.resize(matrix_.vertex_of.size());
    for (std::size_t u = 0; u < mass_.size(); ++u)
        mass_[u] = workspace.mass[matrix_.vertex_of[u]];
    time_step_ = time_step;
    pulls_ = matrix_.screening.exists();

    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
        rows_[i].role = roles[i];
        if (roles[i] == InterfaceRole::Follows)
            make_dirichlet_row(i, values);
        else
            make_transmission_row(i, positions, time_step, workspace.diagonal[vertex_at(i)], values);
    }
    use_other_side(positions, other_side);
    return {values.first(matrix_.n_entries())};
}

/// Moves the coefficients at a vertex of Γ where the sub-mesh follows, so that its value is known in this step, out of
/// the matrix, and makes its row that of the identity. A coefficient between two such vertices is moved with the first
/// of them, and is 0 for the second.
void SymmetricSystem::make_dirichlet_row(std::size_t i, std::span<double> values)
{
    for (Index e = rows_[i].first_entry; e < rows_[i + 1].first_entry; ++e) {
        entries_[e].coefficient = std::exchange(values[entries_[e].slot], 0.0);
    }
    values[matrix_.diagonal_slot(rows_[i].unknown)] = 1.0;
}

/// Adds the responses of the other side to the row of a vertex v of Γ, unless they would make the diagonal of dt K
/// negative. A vertex w beyond Γ is at Ŵ_w + ρ_w (V_v - Vᵏ_v): at its predicted position Ŵ_w, moved by the fraction ρ_w
/// of the movement of v. So its term a_w V_w adds a_w ρ_w to the diagonal, and a_w ρ_w Vᵏ_v - a_w Ŵ_w to the right-hand
/// side (see fill_right_hand_side).
/// @param diagonal dt K_vv.
void SymmetricSystem::make_transmission_row(std::size_t i, const Points& positions, double time_step, double diagonal,
                                            std::span<double> values)
{
    double response = 0.0;
    for (Index c = rows_[i].first_beyond; c < rows_[i + 1].first_beyond; ++c)
        response += beyond_[c].value * remainder_between(positions, vertex_at(i), beyond_[c].vertex, time_step);
    rows_[i].response = diagonal + response >= 0.0 ? response : 0.0;
    values[matrix_.diagonal_slot(rows_[i].unknown)] += rows_[i].response;
}

/// Sets the contributions of the predicted positions beyond Γ to the right-hand side.
/// @param other_side the predicted positions, of which those beyond Γ are read.
void SymmetricSystem::use_other_side(const Points&, const Points& other_side)
{
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
        rows_[i].beyond = Point::Zero();
        if (rows_[i].role == InterfaceRole::Follows)
            continue;
        for (Index c = rows_[i].first_beyond; c < rows_[i + 1].first_beyond; ++c)
            rows_[i].beyond -= beyond_[c].value * other_side.row(beyond_[c].vertex);
    }
}

SubMeshSystem::Factor SymmetricSystem::factorise(const Assembled& equations, FactorMemory& memory,
                                                 SolverWorkspace& workspace)
{
    require_finite_equations(equations.matrix);
    if (auto factor = solver_->factorise(equations.matrix, memory, workspace))
        return std::move(*factor);
    // Responses can make the matrix indefinite.
    drop_responses(equations.matrix);
    return require_factor(solver_->factorise(equations.matrix, memory, workspace));
}

/// Removes all responses. The rows are then those of M + dt K, which is positive definite.
void SymmetricSystem::drop_responses(std::span<double> values)
{
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
        if (rows_[i].role == InterfaceRole::Follows)
            continue;
        values[matrix_.diagonal_slot(rows_[i].unknown)] -= rows_[i].response;
        rows_[i].response = 0.0;
    }
}

/// The data are not stored: `solve` gets them in place of Vᵏ. The attachment to V⁰ is switched off until the next
/// `assemble`, and the data replace the values beyond Γ.
void SymmetricSystem::use_data(const Points& data)
{
    pulls_ = false;
    use_other_side(data, data);
}

void SymmetricSystem::solve(const Factor& factor, const Points& positions, Points& solution, SolverWorkspace& workspace)
{
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] != 0)
            solution.row(v) = positions.row(v);
    fill_right_hand_side(positions, solution, workspace.right_hand_side);
    factor.solve(workspace.right_hand_side, workspace.solution, workspace);
    require_finite_result(workspace.solution.allFinite());
    for (Index u = 0; u < matrix_.n(); ++u)
        if (matrix_.is_vertex(matrix_.vertex_of[u]))
            solution.row(matrix_.vertex_of[u]) = workspace.solution.row(u);
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
        if (rows_[i].role == InterfaceRole::Follows)
            solution.row(vertex_at(i)) = workspace.right_hand_side.row(rows_[i].unknown);
}

/// Computes the right-hand side: M Vᵏ, and dt M w V⁰ if there is an attachment with weights w; less the coefficients at
/// known values; and on Γ, where the sub-mesh leads, what the vertices beyond Γ contribute (see make_transmission_row).
/// @param positions Vᵏ, or the data that the step is applied to. @param known the values at fixed vertices, and on Γ
/// where the sub-mesh follows.
void SymmetricSystem::fill_right_hand_side(const Points& positions, const Points& known, Columns& right) const
{
    set_rows(right, matrix_.n());
    // Auxiliary unknowns, which are no vertices, have no mass.
    for (Index u = 0; u < matrix_.n(); ++u)
        right.row(u) = matrix_.is_vertex(matrix_.vertex_of[u]) ? Point(mass_[u] * positions.row(matrix_.vertex_of[u]))
                                                               : Point(Point::Zero());
    const Screening& screening = matrix_.screening;
    for (Index u = 0; pulls_ && u < matrix_.n(); ++u) {
        const Index v = matrix_.vertex_of[u];
        if (matrix_.is_vertex(v))
            right.row(u) += mass_[u] * time_step_ * screening.weight(v) * screening.initial.row(v);
    }
    for (const Coupling& coupling : fixed_)
        right.row(coupling.unknown) -= coupling.value * known.row(coupling.vertex);
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
        for (Index e = rows_[i].first_entry; rows_[i].role == InterfaceRole::Follows && e < rows_[i + 1].first_entry;
             ++e)
            right.row(entries_[e].unknown) -= entries_[e].coefficient * known.row(vertex_at(i));
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
        const InterfaceRow& row = rows_[i];
        // Where the sub-mesh follows, the row is that of the identity.
        if (row.role == InterfaceRole::Follows)
            right.row(row.unknown) = known.row(vertex_at(i));
        else
            right.row(row.unknown) += row.beyond + row.response * positions.row(vertex_at(i));
    }
}

}  // namespace seamflow
