#include "solvers/estimate/whole_rows.h"

#include <algorithm>
#include <cstdint>

#include "solvers/laplacian/ptackova_velho.h"

namespace seamflow {

WholeRows::WholeRows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                     InterfaceRanks& ranks)
    : copies_(decomposition)
    , shared_(shared_copies(copies_, ranks))
{
    list_rows(decomposition, mesh, topology, ranks);
    list_faces(mesh, topology);
    of_rows_.setZero(std::ssize(vertices_), 3);
    of_copies_.setZero(copies_.n_copies(), 3);
}

/// Lists the rows at Γ and beside Γ, sub-mesh by sub-mesh. All faces around a vertex beside Γ are in one sub-mesh.
void WholeRows::list_rows(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                          const InterfaceRanks& ranks)
{
    std::vector<Index> all_beside;
    std::vector<Index> number(usize(mesh.n_vertices()), -1);
    std::vector<Index> beside;
    for (Index s = 0; s < static_cast<Index>(decomposition.sub_meshes.size()); ++s) {
        if (!ranks.is_own(s))
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
                faces_at_.values.push_back(sub_mesh.faces[f]);
                for (const Index v : sub_mesh.face_vertices[f])
                    if (is_beside[v] != 0)
                        beside.push_back(sub_mesh.local_to_global[v]);
            }
            faces_at_.close();
            vertices_.push_back(sub_mesh.local_to_global[interface.vertices[i]]);
            copy_of_row_.push_back(copies_.offsets[s] + i);
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
            faces_at_.values.push_back(topology.face_of[corner]);
        faces_at_.close();
        vertices_.push_back(v);
    }
}

/// Fills faces_ and number_, and replaces the faces of faces_at_ by their indices in faces_.
void WholeRows::list_faces(const PolygonMesh& mesh, const Topology& topology)
{
    number_.assign(usize(mesh.n_faces()), -1);
    const auto add = [&](Index f) {
        if (number_[f] >= 0)
            return;
        number_[f] = static_cast<Index>(faces_.size());
        faces_.push_back({f, Eigen::Matrix3d::Zero(), 0.0, Point::Zero()});
    };
    for (Index& f : faces_at_.values) {
        add(f);
        f = number_[f];
    }
    n_inner_ = static_cast<Index>(faces_.size());
    for (Index i = 0; i < n_inner_; ++i) {
        const Index f = faces_[i].index;
        for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h)
            if (const Index twin = topology.twin[h]; twin >= 0)
                add(topology.face_of[twin]);
    }
}

/// Computes of_rows_.
void WholeRows::evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                         double time_step, const Executor& exec)
{
    for_each(exec, static_cast<Index>(faces_.size()), [&](Index i) {
        Face& face = faces_[i];
        face.area = area(mesh.face(face.index), before);
        face.flux = PtackovaVelho::flux_map(mesh.face(face.index), before, after, face.area);
    });
    const auto flux_map_of = [&](Index f) -> const Eigen::Matrix3d& { return faces_[number_[f]].flux; };
    for_each(exec, n_inner_, [&](Index i) {
        Face& face = faces_[i];
        face.share = PtackovaVelho::corner_share(mesh, topology, before, face.index, flux_map_of);
    });
    for_each(exec, static_cast<Index>(vertices_.size()), [&](Index i) {
        const Index v = vertices_[i];
        Point laplacian = Point::Zero();
        double vertex_area = 0.0;
        for (const Index number : faces_at_[i]) {
            const Face& face = faces_[number];
            laplacian += face.share;
            vertex_area += corner_area(face.area, mesh.face(face.index).size());
        }
        of_rows_.row(i) = vertex_area * (after.row(v) - before.row(v)) + time_step * laplacian;
    });
}

void WholeRows::measure(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                        double time_step, const Executor& exec)
{
    evaluate(mesh, topology, before, after, time_step, exec);
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
    for (const Index copy : copies_.of_vertex[copies_.vertex[copies_.offsets[s] + i]])
        sum += of_copies_.row(copy);
    return sum;
}

}  // namespace seamflow
