#include <utility>

#include "solvers/conditions/dirichlet.h"
#include "solvers/conditions/predicted_side.h"
#include "solvers/systems/general_system.h"
#include "solvers/systems/symmetric_system.h"

namespace seamflow {

namespace {

/// Whether the rows on Γ are those of a symmetric matrix.
bool has_symmetric_rows(const SubMesh& sub_mesh, Laplacian laplacian)
{
    Index i = 0;
    while (i < sub_mesh.interface.size() && responds_at(sub_mesh, laplacian, i))
        ++i;
    return is_symmetric(laplacian) && i == sub_mesh.interface.size();
}

}  // namespace

std::unique_ptr<SubMeshSystem> make_system(SystemParts parts, std::unique_ptr<TransmissionCondition> condition,
                                           SolverWorkspace& workspace)
{
    if (parts.sub_mesh.interface.vertices.empty())
        return make_following_system(std::move(parts), workspace);
    return std::make_unique<GeneralSystem>(std::move(parts), std::move(condition));
}

std::unique_ptr<SubMeshSystem> make_predicted_system(SystemParts parts, SolverWorkspace& workspace)
{
    if (has_symmetric_kind(parts.factorisation) && has_symmetric_rows(parts.sub_mesh, parts.laplacian))
        return std::make_unique<SymmetricSystem>(parts, SymmetricRows::Transmission, workspace);
    const Points* const first = parts.terms.keeps_stiffness ? parts.terms.initial : nullptr;
    const Points stiffness_at = first != nullptr ? rows_of(*first, parts.sub_mesh.local_to_global) : Points(0, 3);
    auto condition = make_predicted_side(parts.sub_mesh, parts.laplacian, first != nullptr ? &stiffness_at : nullptr);
    return make_system(std::move(parts), std::move(condition), workspace);
}

std::unique_ptr<SubMeshSystem> make_following_system(SystemParts parts, SolverWorkspace& workspace)
{
    if (has_symmetric_kind(parts.factorisation) && is_symmetric(parts.laplacian))
        return std::make_unique<SymmetricSystem>(parts, SymmetricRows::Dirichlet, workspace);
    auto condition = make_dirichlet(parts.sub_mesh);
    return std::make_unique<GeneralSystem>(std::move(parts), std::move(condition));
}

}  // namespace seamflow
