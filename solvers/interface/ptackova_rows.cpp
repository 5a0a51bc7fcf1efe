#include "solvers/interface/ptackova_rows.h"

namespace seamflow {

PtackovaRows::PtackovaRows(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> vertices)
    : vertices_(vertices.begin(), vertices.end())
    , number_(at(mesh.n_faces()), -1)
{
    const auto add = [&](Index f) {
        if (number_[at(f)] >= 0)
            return;
        number_[at(f)] = static_cast<Index>(faces_.size());
        faces_.push_back({f, Eigen::Matrix3d::Zero(), 0.0, Point::Zero()});
    };
    for (const Index v : vertices_)
        for (const Index corner : topology.corners_at(v))
            add(topology.face_of[at(corner)]);
    n_inner_ = static_cast<Index>(faces_.size());
    for (Index i = 0; i < n_inner_; ++i) {
        const Index f = faces_[at(i)].index;
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h)
            if (const Index twin = topology.twin[at(h)]; twin >= 0)
                add(topology.face_of[at(twin)]);
    }
}

void PtackovaRows::measure_flux(Face& face, const PolygonMesh& mesh, const Points& before, const Points& after) const
{
    const auto corners = mesh.face(face.index);
    const Point origin = after.row(corners[0]);
    face.flux.setZero();
    for (std::size_t k = 1; k < corners.size(); ++k)
        face.flux += corner_bisector(corners, k, before).transpose() * (after.row(corners[k]) - origin);
    face.area = area(corners, before);
    face.flux /= face.area;
}

/// The fluxes into the face across its edges; on the mesh's own boundary there is none but its own.
void PtackovaRows::share_out(Face& face, const PolygonMesh& mesh, const Topology& topology, const Points& before) const
{
    Point sum = Point::Zero();
    const Index begin = mesh.face_offsets[at(face.index)];
    const Index end = mesh.face_offsets[at(face.index) + 1];
    for (Index h = begin; h < end; ++h) {
        const Index twin = topology.twin[at(h)];
        const Index across = twin >= 0 ? twin : h;
        const Point edge = before.row(mesh.face_vertices[at(topology.next(mesh, across))]) -
                           before.row(mesh.face_vertices[at(across)]);
        const Point flux = edge * faces_[at(number_[at(topology.face_of[at(across)])])].flux;
        sum += twin >= 0 ? flux : Point(-flux);
    }
    face.share = sum / (2.0 * static_cast<double>(end - begin));
}

void PtackovaRows::evaluate(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                            const Points& after, double time_step, const Loop& loop, Points& residuals)
{
    for_each(loop, static_cast<Index>(faces_.size()),
             [&](Index i) { measure_flux(faces_[at(i)], mesh, before, after); });
    for_each(loop, n_inner_, [&](Index i) { share_out(faces_[at(i)], mesh, topology, before); });
    for_each(loop, static_cast<Index>(vertices_.size()), [&](Index i) {
        const Index v = vertices_[at(i)];
        Point laplacian = Point::Zero();
        double vertex_area = 0.0;
        for (const Index corner : topology.corners_at(v)) {
            const Face& face = faces_[at(number_[at(topology.face_of[at(corner)])])];
            laplacian += face.share;
            vertex_area += face.area / static_cast<double>(mesh.face(face.index).size());
        }
        residuals.row(i) = vertex_area * (after.row(v) - before.row(v)) + time_step * laplacian;
    });
}

}  // namespace seamflow
