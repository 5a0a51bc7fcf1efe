#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "partition/errors.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/simd.h"
#include "solvers/sparse/elimination_order.h"
#include "solvers/systems/messages.h"
#include "solvers/systems/upper_pattern.h"

namespace seamflow {

namespace {

/// How far ahead rows of the factor are asked for, and in what portions, in numbers.
constexpr Index rows_ahead = 6;
constexpr Index cache_line = 64 / sizeof(double);

/// v[0 … n - 1] += row[0 … n - 1] · factor, for three columns.
SEAMFLOW_WIDE void add_row(const double* __restrict row, Index n, const Point& factor, Columns& v)
{
    for (Eigen::Index c = 0; c < 3; ++c) {
        double* __restrict column = v.col(c).data();
        const double f = factor[c];
        for (Index j = 0; j < n; ++j)
            column[j] += row[j] * f;
    }
}

/// row[0 … n - 1] · v[0 … n - 1], for three columns; by four sums each, as wide registers have them.
SEAMFLOW_WIDE Point multiply_row(const double* __restrict row, Index n, const Columns& v)
{
    Point result;
    for (Eigen::Index c = 0; c < 3; ++c) {
        const double* __restrict column = v.col(c).data();
        double sums[4] = {};
        const Index n_whole = n / 4 * 4;
        for (Index j = 0; j < n_whole; j += 4)
            for (Index k = 0; k < 4; ++k)
                sums[k] += row[j + k] * column[j + k];
        for (Index j = n_whole; j < n; ++j)
            sums[0] += row[j] * column[j];
        result[c] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }
    return result;
}

}  // namespace

NeumannSystem::NeumannSystem(const SubMesh& sub_mesh, Laplacian laplacian)
    : sub_mesh_(&sub_mesh)
    , laplacian_(
          make_symmetric_laplacian(laplacian, {sub_mesh.face_vertices, sub_mesh.interface.halo_faces, sub_mesh.twin,
                                               sub_mesh.n_vertices + sub_mesh.n_halo, Contributions::OwnFaces}))
{
    const SparsePattern upper = number_unknowns();
    column_offsets_ = upper.column_offsets;
    std::replace(slots_.begin(), slots_.end(), Index{-1}, n_entries());
    solver_ = std::make_unique<LdlSolver>(upper, n_interface());
}

/// The interior in the order of elimination, then Γ.
/// @returns the pattern of the upper triangle.
SparsePattern NeumannSystem::number_unknowns()
{
    std::vector<bool> on_interface(sub_mesh_->n_vertices, false);
    for (const Index v : sub_mesh_->interface.vertices)
        on_interface[v] = true;
    std::vector<Index> unknown_of(sub_mesh_->n_vertices, -1);
    std::vector<Index> vertices;
    std::vector<bool> is_last;
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[v] == 0) {
            unknown_of[v] = static_cast<Index>(vertices.size());
            vertices.push_back(v);
            is_last.push_back(on_interface[v]);
        }
    const PairsOfUnknowns pairs_of =
        pairs_of_unknowns(laplacian_->pairs(), unknown_of, static_cast<Index>(vertices.size()));
    std::vector<Index> order(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    order = elimination_order(upper_pattern(pairs_of, order).pattern, is_last);
    std::erase_if(order, [&](Index u) { return is_last[u]; });
    for (const Index v : sub_mesh_->interface.vertices)
        order.push_back(unknown_of[v]);
    vertex_of_.reserve(order.size());
    for (const Index u : order)
        vertex_of_.push_back(vertices[u]);
    auto [pattern, slots] = upper_pattern(pairs_of, order);
    slots_ = std::move(slots);
    return std::move(pattern);
}

void NeumannSystem::assemble(const Points& positions, double time_step, SolverWorkspace& workspace)
{
    const Index n_vertices = sub_mesh_->n_vertices + sub_mesh_->n_halo;
    workspace.values.assign(at(n_entries()) + 1, 0.0);
    workspace.diagonal.resize(n_vertices);
    workspace.mass.resize(n_vertices);
    set_rows(workspace.product, n_vertices);
    laplacian_->assemble(positions, time_step, slots_, workspace.values, workspace.diagonal, workspace.mass,
                         &workspace.product);
    for (std::size_t u = 0; u < vertex_of_.size(); ++u) {
        const Index v = vertex_of_[u];
        workspace.values[diagonal_slot(column_offsets_, static_cast<Index>(u))] =
            workspace.mass[v] + workspace.diagonal[v];
    }
}

void NeumannSystem::factorise(SolverWorkspace& workspace)
{
    factorise_again(workspace);
    if (!vertex_of_.empty())
        schur_.take(solver_->last());
}

void NeumannSystem::factorise_again(SolverWorkspace& workspace)
{
    if (vertex_of_.empty())
        return;
    const auto values = std::span<const double>(workspace.values).first(n_entries());
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError(equations_not_finite);
    FactorMemory& memory = borrows_memory_ ? *workspace.factors : memory_;
    if (!solver_->factorise(values, memory, workspace.ldl))
        throw ComputationError(system_singular);
}

void NeumannSystem::give_back_interior(SolverWorkspace& workspace)
{
    const DenseLdl factor = solver_->last();
    last_.resize(row_of_last(n_interface()));
    for (Index i = 0; i < n_interface(); ++i)
        std::copy_n(factor.row(i).data(), i + 1, last_.begin() + static_cast<std::ptrdiff_t>(row_of_last(i)));
    give_back(workspace);
}

void NeumannSystem::give_back(SolverWorkspace& workspace)
{
    assert(borrows_memory_ && "its own memory is nobody else's");
    solver_->free_factor(*workspace.factors);
}

/// A row of L on Γ, and then D.
const double* NeumannSystem::last_row(Index i) const
{
    return solver_->has_factor() ? solver_->last().row(i).data() : last_.data() + row_of_last(i);
}

void NeumannSystem::condense(Points& eliminated, Eigen::Ref<Points> condensed, const SolverWorkspace& workspace) const
{
    set_rows(eliminated, static_cast<Eigen::Index>(vertex_of_.size()));
    for (std::size_t u = 0; u < vertex_of_.size(); ++u)
        eliminated.row(static_cast<Eigen::Index>(u)) = -workspace.product.row(vertex_of_[u]);
    if (!vertex_of_.empty())
        solver_->eliminate(eliminated);
    condensed = eliminated.bottomRows(n_interface());
}

void NeumannSystem::subtract_schur(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const
{
    Columns scaled = x;
    for (Index i = 0; i < n_interface(); ++i) {
        // Rows of the factor end before the memory between them does, which processors do not foresee.
        const Index next = std::min(i + rows_ahead, n_interface() - 1);
        for (Index j = 0; j <= next; j += cache_line)
            __builtin_prefetch(last_row(next) + j);
        add_row(last_row(i), i, x.row(i), scaled);
    }
    for (Index i = 0; i < n_interface(); ++i)
        scaled.row(i) *= last_row(i)[i];
    for (Index i = 0; i < n_interface(); ++i)
        result.row(i) -= scaled.row(i) + multiply_row(last_row(i), i, scaled);
}

void NeumannSystem::fill_in(Points& solution) const
{
    if (!vertex_of_.empty())
        solver_->substitute_back(solution);
    if (!solution.allFinite())
        throw ComputationError(result_not_finite);
}

}  // namespace seamflow
