#include "solvers/estimate/whole_rows.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace seamflow {

WholeRows::WholeRows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                     InterfacePeers& peers)
    : copies_(decomposition)
    , shared_(shared_copies(copies_, peers))
    , rows_([&] {
        Parts parts = list_parts(decomposition, mesh, topology, peers);
        return PtackovaRows(mesh, topology, std::move(parts.vertices), std::move(parts.faces));
    }())
{
    of_rows_.setZero(std::ssize(copy_of_row_) + std::ssize(n_sharing_), 3);
    of_copies_.setZero(copies_.n_copies(), 3);
}

/// Sub-mesh by sub-mesh: vertices beside Γ have all their faces in one.
WholeRows::Parts WholeRows::list_parts(const Decomposition& decomposition, const PolygonMesh& mesh,
                                       const Topology& topology, const InterfacePeers& peers)
{
    Parts parts;
    std::vector<Index> all_beside;
    std::vector<Index> number(usize(mesh.n_vertices()), -1);
    std::vector<Index> beside;
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
        if (!peers.is_own(s))
            continue;
        const SubMesh& sub_mesh = decomposition.sub_meshes[s];
        const SubMeshInterface& interface = sub_mesh.interface;
        std::vector<std::uint8_t> is_beside(sub_mesh.fixed.size());
        std::ranges::transform(sub_mesh.fixed, is_beside.begin(), [](std::uint8_t fixed) { return fixed == 0; });
        for (const Index v : interface.vertices)
            is_beside[v] = 0;
        for (Index i = 0; i < interface.size(); ++i) {
            beside.clear();
            for (const Index f : interface.own_faces[i]) {
                parts.faces.values.push_back(sub_mesh.faces[f]);
                for (const Index v : sub_mesh.face_vertices[f])
                    if (is_beside[v] != 0)
                        beside.push_back(sub_mesh.local_to_global[v]);
            }
            parts.faces.close();
            parts.vertices.push_back(sub_mesh.local_to_global[interface.vertices[i]]);
            copy_of_row_.push_back(copies_.first[s] + i);
            sort_unique(beside);
            for (const Index v : beside) {
                if (number[v] < 0) {
                    number[v] = static_cast<Index>(all_beside.size());
                    all_beside.push_back(v);
                    n_sharing_.push_back(0);
                }
                ++n_sharing_[number[v]];
                beside_.values.push_back(number[v]);
            }
            beside_.close();
        }
    }
    for (const Index v : all_beside) {
        for (const Index corner : topology.corners_at(v))
            parts.faces.values.push_back(topology.face_of[corner]);
        parts.faces.close();
        parts.vertices.push_back(v);
    }
    return parts;
}

void WholeRows::measure(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                        double time_step, const Executor& exec)
{
    rows_.evaluate(mesh, topology, before, after, time_step, exec, of_rows_);
    const auto n = static_cast<Index>(copy_of_row_.size());
    for_each(exec, n, [&](Index row) {
        Point sum = of_rows_.row(row);
        for (const Index other : beside_[row])
            sum += of_rows_.row(n + other) / n_sharing_[other];
        of_copies_.row(copy_of_row_[row]) = sum;
    });
    shared_.exchange(of_copies_.data(), 3);
}

Point WholeRows::residual(Index s, Index i) const
{
    Point sum = Point::Zero();
    for (const Index copy : copies_.of_vertex[copies_.vertex[copies_.first[s] + i]])
        sum += of_copies_.row(copy);
    return sum;
}

}  // namespace seamflow
