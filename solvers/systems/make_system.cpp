#include <algorithm>

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
bool yields_everywhere(const SubMesh& sub_mesh, Laplacian laplacian)
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

std::unique_ptr<SubMeshSystem> make_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                           std::unique_ptr<TransmissionCondition> condition, SolverWorkspace& workspace,
                                           Factorisation factorisation)
{
    if (sub_mesh.interface.vertices.empty())
        return make_following_system(sub_mesh, laplacian, workspace, factorisation);
    return std::make_unique<GeneralSystem>(sub_mesh, laplacian, std::move(condition), factorisation);
}

std::unique_ptr<SubMeshSystem> make_predicted_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                                     SolverWorkspace& workspace, Factorisation factorisation)
{
    if (factorisation != Factorisation::Umfpack && yields_everywhere(sub_mesh, laplacian))
        return std::make_unique<SymmetricSystem>(sub_mesh, laplacian, SymmetricRows::Yielding, factorisation,
                                                 workspace);
    return make_system(sub_mesh, laplacian, make_predicted_side(sub_mesh, laplacian), workspace, factorisation);
}

std::unique_ptr<SubMeshSystem> make_following_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                                     SolverWorkspace& workspace, Factorisation factorisation)
{
    if (factorisation != Factorisation::Umfpack && is_symmetric(laplacian))
        return std::make_unique<SymmetricSystem>(sub_mesh, laplacian, SymmetricRows::None, factorisation, workspace);
    return std::make_unique<GeneralSystem>(sub_mesh, laplacian, make_dirichlet(sub_mesh), factorisation);
}

}  // namespace seamflow
