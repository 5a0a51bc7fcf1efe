#include <algorithm>
#include <utility>

#include "solvers/conditions/dirichlet.h"
#include "solvers/conditions/predicted_side.h"
#include "solvers/systems/general_system.h"
#include "solvers/systems/symmetric_system.h"

namespace seamflow {

namespace {

bool are_triangles(const IndexLists& fans, const IndexLists& faces)
{
    return std::all_of(fans.values.begin(), fans.values.end(), [&](Index f) { return faces[f].size() == 3; });
}

/// Whether the rows on Γ are those of a symmetric matrix: see predicted_side.h.
bool has_symmetric_rows(const SubMesh& sub_mesh, Laplacian laplacian)
{
    const auto& interface = sub_mesh.interface;
    const LaplacianTraits& traits = traits_of(laplacian);
    if (!traits.is_symmetric)
        return false;
    return traits.reach == Reach::Edges ||
           (traits.reach == Reach::Faces && are_triangles(interface.own_faces, sub_mesh.face_vertices) &&
            are_triangles(interface.complement_faces, interface.halo_faces));
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
    if (parts.factorisation != Factorisation::Umfpack && has_symmetric_rows(parts.sub_mesh, parts.laplacian))
        return std::make_unique<SymmetricSystem>(parts, SymmetricRows::Transmission, workspace);
    const Points* const first = parts.terms.keeps_stiffness ? parts.terms.first : nullptr;
    const Points stiffness_at = first != nullptr ? rows_of(*first, parts.sub_mesh.local_to_global) : Points(0, 3);
    auto condition = make_predicted_side(parts.sub_mesh, parts.laplacian, first != nullptr ? &stiffness_at : nullptr);
    return make_system(std::move(parts), std::move(condition), workspace);
}

std::unique_ptr<SubMeshSystem> make_following_system(SystemParts parts, SolverWorkspace& workspace)
{
    if (parts.factorisation != Factorisation::Umfpack && is_symmetric(parts.laplacian))
        return std::make_unique<SymmetricSystem>(parts, SymmetricRows::Dirichlet, workspace);
    auto condition = make_dirichlet(parts.sub_mesh);
    return std::make_unique<GeneralSystem>(std::move(parts), std::move(condition));
}

}  // namespace seamflow
