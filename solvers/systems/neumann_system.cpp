#include "solvers/systems/neumann_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/direct/columns.h"
#include "solvers/sparse/elimination_ordering.h"
#include "solvers/systems/checks.h"

namespace seamflow {

NeumannSystem::NeumannSystem(const SubMesh& sub_mesh, IndexLists faces, Laplacian laplacian)
    : n_interface_(sub_mesh.interface.size())
    , faces_(std::move(faces))
    , matrix_{make_symmetric_laplacian(laplacian, {faces_, sub_mesh.interface.halo_faces, sub_mesh.twin,
                                                   sub_mesh.n_vertices + sub_mesh.n_halo, Contributions::OwnFaces}),
              sub_mesh.n_vertices + sub_mesh.n_halo}
    , solver_(number_unknowns(sub_mesh), n_interface_)
{
    if (!matrix_.laplacian->uses_faces())
        faces_ = {};
}

/// The interior in the elimination ordering, then Γ.
/// @returns the pattern of the upper triangle.
SparsePattern NeumannSystem::number_unknowns(const SubMesh& sub_mesh)
{
    std::vector<bool> on_interface(sub_mesh.n_vertices, false);
    for (const Index v : sub_mesh.interface.vertices)
        on_interface[v] = true;
    std::vector<Index> unknown_of(sub_mesh.n_vertices, -1);
    std::vector<Index> vertices;
    std::vector<bool> is_last;
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        if (sub_mesh.fixed[v] == 0) {
            unknown_of[v] = static_cast<Index>(vertices.size());
            vertices.push_back(v);
            is_last.push_back(on_interface[v]);
        }
    const PairsOfUnknowns pairs_of =
        pairs_of_unknowns(matrix_.laplacian->pairs(), unknown_of, static_cast<Index>(vertices.size()));
    std::vector<Index> order(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    order = elimination_ordering(upper_pattern(pairs_of, order).pattern, is_last);
    std::erase_if(order, [&](Index u) { return is_last[u]; });
    for (const Index v : sub_mesh.interface.vertices)
        order.push_back(unknown_of[v]);
    matrix_.vertex_of.reserve(order.size());
    for (const Index u : order)
        matrix_.vertex_of.push_back(vertices[u]);
    auto [pattern, slots] = upper_pattern(pairs_of, order);
    matrix_.column_offsets = pattern.column_offsets;
    std::replace(slots.begin(), slots.end(), Index{-1}, matrix_.n_entries());
    matrix_.slots = std::move(slots);
    return std::move(pattern);
}

NeumannSystem::Assembled NeumannSystem::assemble(const Points& positions, double time_step,
                                                 SolverWorkspace& workspace) const
{
    set_rows(workspace.product, matrix_.n_vertices);
    return {matrix_.fill(positions, time_step, 0, workspace, &workspace.product), workspace.product};
}

LdlSolver::Factor NeumannSystem::factorise(const Assembled& equations, FactorMemory& memory,
                                           LdlWorkspace& workspace) const
{
    require_finite_equations(equations.matrix);
    return require_factor(solver_.factorise(equations.matrix, memory, workspace));
}

void NeumannSystem::condense(const Assembled& equations, const LdlSolver::Factor& factor, Points& condensed) const
{
    set_rows(condensed, matrix_.n());
    for (Index u = 0; u < matrix_.n(); ++u)
        condensed.row(u) = -equations.product.row(matrix_.vertex_of[u]);
    factor.forward_substitute(condensed);
}

void NeumannSystem::back_substitute(const LdlSolver::Factor& factor, Points& solution)
{
    factor.back_substitute(solution);
    require_finite_result(solution.allFinite());
}

}  // namespace seamflow
