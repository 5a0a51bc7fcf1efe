#include "engine/sweep/interface_gaps.h"

#include <algorithm>

#include "engine/tasks/parallel_executor.h"

namespace seamflow {

namespace {

/// The largest distance between two copies of the i-th vertex of a sub-mesh's Γ.
double largest_distance(const std::vector<SubMeshState>& states, const SubMeshInterface& interface, Index i)
{
    const auto copy = [&](std::size_t k) -> Point {
        return states[interface.sharing[i][k]].position.row(interface.index_in_sharing[i][k]);
    };
    double largest = 0.0;
    for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
        for (std::size_t l = 0; l < k; ++l)
            largest = std::max(largest, (copy(k) - copy(l)).norm());
    return largest;
}

}  // namespace

InterfaceGaps::InterfaceGaps(const PolygonMesh& mesh, const Decomposition& decomposition, bool keeps_separated)
    : decomposition_(&decomposition)
    , gaps_(decomposition.n_interface_vertices, 0.0)
{
    if (keeps_separated)
        separated_ = separate(mesh, decomposition);
    std::size_t n = 0;
    for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s) {
        first_gap_.push_back(n);
        const auto& interface = decomposition.sub_meshes[s].interface;
        for (Index i = 0; i < interface.size(); ++i)
            n += interface.sharing[i].front() == static_cast<Index>(s) ? 1 : 0;
    }
}

void InterfaceGaps::join(const std::vector<SubMeshState>& states, Points& positions)
{
    for_each(run_in_parallel, static_cast<Index>(states.size()), [&](Index s) {
        join_interface_of(s, states, positions);
        if (!separated_)
            return;
        const auto& vertex_of = separated_->vertex_of[s];
        for (std::size_t v = 0; v < vertex_of.size(); ++v)
            separated_->mesh.vertices.row(vertex_of[v]) = states[s].position.row(static_cast<Eigen::Index>(v));
    });
}

/// Sets the means and the gaps at the vertices of Γ at which no sub-mesh has a lower number than s.
void InterfaceGaps::join_interface_of(Index s, const std::vector<SubMeshState>& states, Points& positions)
{
    const SubMesh& sub_mesh = decomposition_->sub_meshes[s];
    const auto& interface = sub_mesh.interface;
    std::size_t gap = first_gap_[s];
    for (Index i = 0; i < interface.size(); ++i) {
        if (interface.sharing[i].front() != s)
            continue;
        positions.row(sub_mesh.local_to_global[interface.vertices[i]]) =
            mean_of_copies(states, interface, i, &SubMeshState::position);
        gaps_[gap++] = largest_distance(states, interface, i);
    }
}

}  // namespace seamflow
