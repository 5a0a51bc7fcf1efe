#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "partition/errors.h"
#include "solvers/elimination_order.h"
#include "solvers/set_rows.h"
#include "solvers/systems/messages.h"
#include "solvers/systems/upper_pattern.h"
#include "solvers/wide.h"

namespace seamflow {

namespace {

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
    const std::vector<VertexPair> pairs = laplacian_->pairs();
    std::vector<Index> unknown_of;
    number_unknowns(pairs, unknown_of);
    list_couplings(pairs, unknown_of);
    solver_ = std::make_unique<LdlSolver>(upper_, n_interface());
}

/// The interior in the order of elimination, then Γ.
/// @param unknown_of receives one entry per own vertex, -1 where it is none.
void NeumannSystem::number_unknowns(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of)
{
    std::vector<bool> on_interface(at(sub_mesh_->n_vertices), false);
    for (const Index v : sub_mesh_->interface.vertices)
        on_interface[at(v)] = true;
    unknown_of.assign(at(sub_mesh_->n_vertices), -1);
    std::vector<Index> vertices;
    std::vector<bool> is_last;
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[at(v)] == 0) {
            unknown_of[at(v)] = static_cast<Index>(vertices.size());
            vertices.push_back(v);
            is_last.push_back(on_interface[at(v)]);
        }
    const auto n = static_cast<Index>(vertices.size());
    const auto order = elimination_order(upper_pattern(pairs, unknown_of, n).pattern, is_last);
    for (const Index u : order)
        if (!is_last[at(u)])
            vertex_of_.push_back(vertices[at(u)]);
    vertex_of_.insert(vertex_of_.end(), sub_mesh_->interface.vertices.begin(), sub_mesh_->interface.vertices.end());
    for (Index u = 0; u < n; ++u)
        unknown_of[at(vertex_of_[at(u)])] = u;
    auto [pattern, slots] = upper_pattern(pairs, unknown_of, n);
    upper_ = std::move(pattern);
    slots_ = std::move(slots);
}

/// What is no entry of the matrix: at fixed vertices.
void NeumannSystem::list_couplings(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of)
{
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        auto [a, b] = pairs[i];
        if (unknown_of[at(a)] < 0)
            std::swap(a, b);
        if (slots_[i] >= 0 || unknown_of[at(a)] < 0)
            continue;
        slots_[i] = upper_.n_entries() + static_cast<Index>(fixed_.size());
        fixed_.push_back({unknown_of[at(a)], b, 0.0});
    }
    std::replace(slots_.begin(), slots_.end(), Index{-1}, upper_.n_entries() + static_cast<Index>(fixed_.size()));
}

void NeumannSystem::assemble(const Points& positions, double time_step, SolverWorkspace& workspace)
{
    const auto n_entries = at(upper_.n_entries());
    workspace.values.assign(n_entries + fixed_.size() + 1, 0.0);
    workspace.diagonal.resize(at(sub_mesh_->n_vertices + sub_mesh_->n_halo));
    workspace.mass.resize(workspace.diagonal.size());
    laplacian_->assemble(positions, time_step, slots_, workspace.values, workspace.diagonal, workspace.mass);
    for (std::size_t u = 0; u < vertex_of_.size(); ++u) {
        const Index v = vertex_of_[u];
        workspace.values[at(diagonal_slot(upper_.column_offsets, static_cast<Index>(u)))] =
            workspace.mass[at(v)] + workspace.diagonal[at(v)];
    }
    for (std::size_t c = 0; c < fixed_.size(); ++c)
        fixed_[c].value = workspace.values[n_entries + c];
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
    const auto values = std::span<const double>(workspace.values).first(at(upper_.n_entries()));
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

/// The rows of K add up to zero: K V is made of differences, and has no rounding error of the size of V.
void NeumannSystem::condense(const Points& positions, Points& eliminated, Eigen::Ref<Points> condensed,
                             const SolverWorkspace& workspace) const
{
    set_rows(eliminated, static_cast<Eigen::Index>(vertex_of_.size()));
    eliminated.setZero();
    for (Index column = 0; column < upper_.n(); ++column) {
        const Point here = positions.row(vertex_of_[at(column)]);
        Point sum = Point::Zero();
        for (Index slot = upper_.column_offsets[at(column)]; slot < diagonal_slot(upper_.column_offsets, column);
             ++slot) {
            const Index row = upper_.rows[at(slot)];
            const Point flux = workspace.values[at(slot)] * (positions.row(vertex_of_[at(row)]) - here);
            eliminated.row(row) += flux;
            sum += flux;
        }
        eliminated.row(column) -= sum;
    }
    for (const Coupling& coupling : fixed_)
        eliminated.row(coupling.unknown) -=
            coupling.value * (positions.row(coupling.vertex) - positions.row(vertex_of_[at(coupling.unknown)]));
    if (!vertex_of_.empty())
        solver_->eliminate(eliminated);
    condensed = eliminated.bottomRows(n_interface());
}

void NeumannSystem::subtract_schur(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const
{
    Columns scaled = x;
    for (Index i = 0; i < n_interface(); ++i)
        add_row(last_row(i), i, x.row(i), scaled);
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
