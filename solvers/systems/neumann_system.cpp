#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <cmath>

#include "partition/errors.h"
#include "solvers/cholmod_solver.h"
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

NeumannSystem::NeumannSystem(const SubMesh& sub_mesh, Laplacian laplacian, SolverWorkspace& workspace)
    : sub_mesh_(&sub_mesh)
    , laplacian_(
          make_symmetric_laplacian(laplacian, {sub_mesh.face_vertices, sub_mesh.interface.halo_faces, sub_mesh.twin,
                                               sub_mesh.n_vertices + sub_mesh.n_halo, Contributions::OwnFaces}))
{
    const std::vector<VertexPair> pairs = laplacian_->pairs();
    number_unknowns(pairs, workspace);
    place_pairs(pairs);
    mass_.resize(vertex_of_.size());
    solver_ = std::make_unique<LdlSolver>(upper_, n_interface());
}

/// The interior in the order of elimination, then Γ.
void NeumannSystem::number_unknowns(const std::vector<VertexPair>& pairs, SolverWorkspace& workspace)
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
    const auto order = elimination_order(upper_pattern(pairs, unknown_of_, n), is_last, workspace.cholmod);
    for (const Index u : order)
        if (!is_last[at(u)])
            vertex_of_.push_back(vertices[at(u)]);
    vertex_of_.insert(vertex_of_.end(), sub_mesh_->interface.vertices.begin(), sub_mesh_->interface.vertices.end());
    for (Index u = 0; u < n; ++u)
        unknown_of_[at(vertex_of_[at(u)])] = u;
    upper_ = upper_pattern(pairs, unknown_of_, n);
    for (Index u = 0; u < n; ++u)
        diagonal_slots_.push_back(upper_.slot({u, u}));
}

void NeumannSystem::place_pairs(const std::vector<VertexPair>& pairs)
{
    constexpr Index unread = -1;
    slots_.reserve(pairs.size());
    for (auto [a, b] : pairs) {
        if (unknown_of_[at(a)] < 0)
            std::swap(a, b);
        const Index unknown = unknown_of_[at(a)];
        if (unknown < 0) {
            slots_.push_back(unread);
        } else if (unknown_of_[at(b)] >= 0) {
            slots_.push_back(upper_.slot(upper_entry(unknown, unknown_of_[at(b)])));
        } else {
            slots_.push_back(upper_.n_entries() + static_cast<Index>(fixed_.size()));
            fixed_.push_back({unknown, b, 0.0});
        }
    }
    std::replace(slots_.begin(), slots_.end(), unread, upper_.n_entries() + static_cast<Index>(fixed_.size()));
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
        workspace.values[at(diagonal_slots_[u])] = mass_[u] + workspace.diagonal[at(vertex_of_[u])];
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
    Columns scaled = x;
    for (Index i = 0; i < n_interface(); ++i)
        add_row(factor.row(i).data(), i, x.row(i), scaled);
    scaled.array().colwise() *= factor.diagonal().array();
    for (Index i = 0; i < n_interface(); ++i)
        result.row(i) -= scaled.row(i) + multiply_row(factor.row(i).data(), i, scaled);
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
