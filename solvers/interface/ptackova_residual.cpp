#include "solvers/interface/ptackova_residual.h"

namespace seamflow {

namespace {

/// Σₖ bₖᵀ xₖ / |f|: the map from an edge vector to the flux of x across the edge, b and |f| at Vᵏ, x at Vᵏ⁺¹.
Eigen::Matrix3d flux_map(std::span<const Index> corners, const Points& before, const Points& after)
{
    const Point origin = after.row(corners[0]);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 1; k < corners.size(); ++k)
        sum += corner_bisector(corners, k, before).transpose() * (after.row(corners[k]) - origin);
    return sum / area(corners, before);
}

}  // namespace

Point ptackova_residual(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                        double time_step, Index v)
{
    Point laplacian = Point::Zero();
    double vertex_area = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[at(corner)];
        const auto corners = mesh.face(f);
        const auto p = static_cast<double>(corners.size());
        vertex_area += area(corners, before) / p;
        Point of_face = Point::Zero();
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            const Index across = twin >= 0 ? twin : h;
            const Point edge = before.row(mesh.face_vertices[at(topology.next(mesh, across))]) -
                               before.row(mesh.face_vertices[at(across)]);
            const Point flux = edge * flux_map(mesh.face(topology.face_of[at(across)]), before, after);
            of_face += twin >= 0 ? flux : Point(-flux);
        }
        laplacian += of_face / (2.0 * p);
    }
    return vertex_area * (after.row(v) - before.row(v)) + time_step * laplacian;
}

}  // namespace seamflow
