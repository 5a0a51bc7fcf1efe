#include "solvers/interface/interface_copies.h"

#include <algorithm>
#include <map>
#include <utility>

namespace seamflow {

namespace {

/// A vertex of Γ, by its indices in two sub-meshes.
struct FoundVertex {
    /// The index of the vertex in the Γ of the lowest sub-mesh that has it, whole or not.
    Index in_lowest;
    /// The lowest whole sub-mesh that has the vertex, and its index in the Γ of that sub-mesh.
    Index s;
    Index i;
};

/// The vertices in whole sub-meshes, each in the list of the lowest sub-mesh that has it.
std::vector<std::vector<FoundVertex>> find_vertices(const std::vector<SubMesh>& sub_meshes)
{
    std::vector<std::vector<FoundVertex>> found(sub_meshes.size());
    const auto is_whole = [&](Index t) { return sub_meshes[t].interface.size() > 0; };
    for (Index s = 0; s < static_cast<Index>(sub_meshes.size()); ++s) {
        const SubMeshInterface& interface = sub_meshes[s].interface;
        for (Index i = 0; i < interface.size(); ++i)
            if (const auto sharing = interface.sharing[i]; *std::ranges::find_if(sharing, is_whole) == s)
                found[sharing.front()].push_back({interface.index_in_sharing[i].front(), s, i});
    }
    for (auto& vertices : found)
        std::ranges::sort(vertices, {}, &FoundVertex::in_lowest);
    return found;
}

/// Per sub-mesh: the indices of its listed copies in its Γ, ascending.
std::vector<std::vector<Index>> find_copies(const std::vector<SubMesh>& sub_meshes,
                                            const std::vector<std::vector<FoundVertex>>& found)
{
    std::vector<std::vector<Index>> copies(sub_meshes.size());
    for (const auto& vertices : found)
        for (const auto& [in_lowest, s, i] : vertices) {
            const SubMeshInterface& interface = sub_meshes[s].interface;
            for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
                copies[interface.sharing[i][k]].push_back(interface.index_in_sharing[i][k]);
        }
    for (auto& indices : copies)
        std::ranges::sort(indices);
    return copies;
}

}  // namespace

InterfaceCopies::InterfaceCopies(const Decomposition& decomposition)
{
    const auto& sub_meshes = decomposition.sub_meshes;
    const auto found = find_vertices(sub_meshes);
    const auto copies = find_copies(sub_meshes, found);
    for (const auto& indices : copies)
        offsets.push_back(offsets.back() + static_cast<Index>(indices.size()));
    vertex.assign(n_copies(), -1);
    sub_mesh.assign(n_copies(), -1);
    for (const auto& vertices : found) {
        for (const auto& [in_lowest, s, i] : vertices) {
            const SubMeshInterface& interface = sub_meshes[s].interface;
            for (std::size_t k = 0; k < interface.sharing[i].size(); ++k) {
                const Index t = interface.sharing[i][k];
                const auto position = std::ranges::lower_bound(copies[t], interface.index_in_sharing[i][k]);
                const Index copy = offsets[t] + static_cast<Index>(position - copies[t].begin());
                vertex[copy] = of_vertex.size();
                sub_mesh[copy] = t;
                of_vertex.values.push_back(copy);
            }
            of_vertex.close();
        }
        first_vertex.push_back(of_vertex.size());
    }
}

SharedRows shared_copies(const InterfaceCopies& copies, InterfaceRanks& ranks)
{
    std::map<Index, SharedRows::Lists> with;
    for (const Index copy : copies.of_vertex.values) {
        const auto holder_of = [&](Index c) { return ranks.holder_of(copies.sub_mesh[c]); };
        if (!ranks.is_own(copies.sub_mesh[copy]))
            with[holder_of(copy)].taken.push_back(copy);
        else
            for (const Index other : copies.of_vertex[copies.vertex[copy]])
                if (!ranks.is_own(copies.sub_mesh[other]))
                    with[holder_of(other)].given.push_back(copy);
    }
    for (auto& [other, lists] : with) {
        sort_unique(lists.given);
        sort_unique(lists.taken);
    }
    return {ranks, std::move(with)};
}

}  // namespace seamflow
