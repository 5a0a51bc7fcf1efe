#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <cmath>

#include "partition/errors.h"
#include "solvers/elimination_order.h"
#include "solvers/systems/messages.h"
#include "solvers/systems/upper_pattern.h"

namespace seamflow {

NeumannSystem::NeumannSystem(const SubMesh& sub_mesh, Laplacian laplacian)
    : sub_mesh_(&sub_mesh)
    , laplacian_(
          make_symmetric_laplacian(laplacian, {sub_mesh.face_vertices, sub_mesh.interface.halo_faces, sub_mesh.twin,
                                               sub_mesh.n_vertices + sub_mesh.n_halo, Contributions::OwnFaces}))
{
    const std::vector<VertexPair> pairs = laplacian_->pairs();
    number_unknowns(pairs);
    list_couplings(pairs);
    mass_.resize(vertex_of_.size());
    solver_ = std::make_unique<LdlSolver>(upper_, n_interface());
}

/// The interior in the order of elimination, then Γ.
void NeumannSystem::number_unknowns(const std::vector<VertexPair>& pairs)
{
    std::vector<bool> on_interface(at(sub_mesh_->n_vertices), false);
    for (const Index v : sub_mesh_->interface.vertices)
        on_interface[at(v)] = true;
    unknown_of_.assign(at(sub_mesh_->n_vertices), -1);
    std::vector<Index> vertices;
    std::vector<bool> is_last;
    for (Index v = 0; v < sub_mesh_->n_vertices; ++v)
        if (sub_mesh_->fixed[at(v)] == 0) {
            unknown_of_[at(v)] = static_cast<Index>(vertices.size());
            vertices.push_back(v);
            is_last.push_back(on_interface[at(v)]);
        }
    const auto n = static_cast<Index>(vertices.size());
    const auto order = elimination_order(upper_pattern(pairs, unknown_of_, n).pattern, is_last);
    for (const Index u : order)
        if (!is_last[at(u)])
            vertex_of_.push_back(vertices[at(u)]);
    vertex_of_.insert(vertex_of_.end(), sub_mesh_->interface.vertices.begin(), sub_mesh_->interface.vertices.end());
    for (Index u = 0; u < n; ++u)
        unknown_of_[at(vertex_of_[at(u)])] = u;
    auto [pattern, slots] = upper_pattern(pairs, unknown_of_, n);
    upper_ = std::move(pattern);
    slots_ = std::move(slots);
}

/// What is no entry of the matrix: at fixed vertices.
void NeumannSystem::list_couplings(const std::vector<VertexPair>& pairs)
{
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        auto [a, b] = pairs[i];
        if (unknown_of_[at(a)] < 0)
            std::swap(a, b);
        if (slots_[i] >= 0 || unknown_of_[at(a)] < 0)
            continue;
        slots_[i] = upper_.n_entries() + static_cast<Index>(fixed_.size());
        fixed_.push_back({unknown_of_[at(a)], b, 0.0});
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
        mass_[u] = workspace.mass[at(vertex_of_[u])];
        workspace.values[at(diagonal_slot(upper_, static_cast<Index>(u)))] =
            mass_[u] + workspace.diagonal[at(vertex_of_[u])];
    }
    for (std::size_t c = 0; c < fixed_.size(); ++c)
        fixed_[c].value = workspace.values[n_entries + c];
}

void NeumannSystem::factorise(SolverWorkspace& workspace)
{
    if (vertex_of_.empty())
        return;
    const auto values = std::span<const double>(workspace.values).first(at(upper_.n_entries()));
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError(equations_not_finite);
    if (!solver_->factorise(values, *workspace.factors, workspace.ldl))
        throw ComputationError(system_singular);
    schur_.take(solver_->last());
}

void NeumannSystem::condense(const Points& positions, Points& eliminated, Eigen::Ref<Points> condensed) const
{
    const auto n = static_cast<Eigen::Index>(vertex_of_.size());
    eliminated.resize(n, 3);
    for (Eigen::Index u = 0; u < n; ++u)
        eliminated.row(u) = mass_[static_cast<std::size_t>(u)] * positions.row(vertex_of_[static_cast<std::size_t>(u)]);
    for (const Coupling& coupling : fixed_)
        eliminated.row(coupling.unknown) -= coupling.value * positions.row(coupling.vertex);
    if (n > 0)
        solver_->eliminate(eliminated);
    condensed = eliminated.bottomRows(n_interface());
}

void NeumannSystem::subtract_schur(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const
{
    const DenseLdl factor = solver_->last();
    Points scaled = x;
    for (Index i = 0; i < n_interface(); ++i)
        for (Index j = 0; j < i; ++j)
            scaled.row(j) += factor(i, j) * x.row(i);
    scaled.array().colwise() *= factor.diagonal().array();
    for (Index i = 0; i < n_interface(); ++i) {
        Point sum = scaled.row(i);
        for (Index j = 0; j < i; ++j)
            sum += factor(i, j) * scaled.row(j);
        result.row(i) -= sum;
    }
}

void NeumannSystem::fill_in(Points& solution, SolverWorkspace& workspace)
{
    if (vertex_of_.empty())
        return;
    solver_->substitute_back(solution);
    solver_->free_factor(*workspace.factors);
    if (!solution.allFinite())
        throw ComputationError(result_not_finite);
}

}  // namespace seamflow
