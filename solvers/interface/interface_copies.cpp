#include "solvers/interface/interface_copies.h"

#include <algorithm>

namespace seamflow {

InterfaceCopies::InterfaceCopies(const Decomposition& decomposition)
{
    const auto& sub_meshes = decomposition.sub_meshes;
    for (const SubMesh& part : sub_meshes)
        first.push_back(first.back() + part.interface.size());
    vertex.assign(n_copies(), -1);
    sub_mesh.assign(n_copies(), -1);
    for (Index s = 0; s < n_sub_meshes(); ++s) {
        const auto& interface = sub_meshes[s].interface;
        for (Index i = 0; i < interface.size(); ++i) {
            if (interface.sharing[i].front() != s)
                continue;
            for (std::size_t k = 0; k < interface.sharing[i].size(); ++k) {
                const Index t = interface.sharing[i][k];
                const auto& others = sub_meshes[t].interface.vertices;
                const auto place = std::lower_bound(others.begin(), others.end(), interface.index_in_sharing[i][k]);
                const Index copy = first[t] + static_cast<Index>(place - others.begin());
                vertex[copy] = of_vertex.size();
                sub_mesh[copy] = t;
                of_vertex.values.push_back(copy);
            }
            of_vertex.close();
        }
        first_vertex.push_back(of_vertex.size());
    }
}

}  // namespace seamflow
