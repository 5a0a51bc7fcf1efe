#include "solvers/estimate/ptackova_rows.h"

#include <utility>

#include "solvers/laplacian/ptackova_velho.h"

namespace seamflow {

PtackovaRows::PtackovaRows(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> vertices,
                           IndexLists faces)
    : vertices_(std::move(vertices))
    , faces_at_(std::move(faces))
    , number_(mesh.n_faces(), -1)
{
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

void PtackovaRows::evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                            const Points& after, double time_step, const Executor& exec, Points& residuals)
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
        residuals.row(i) = vertex_area * (after.row(v) - before.row(v)) + time_step * laplacian;
    });
}

}  // namespace seamflow
