#include "solvers/laplacian/mean_curvature.h"

#include "solvers/laplacian/vertex_row.h"

namespace seamflow {

namespace {

/// (ΔV)_v = Σ_w K_vw (V_w - V_v) / M_v
template <class Kernel>
requires EdgeKernel<Kernel> || FaceKernel<Kernel> Point curvature_by(Kernel kernel, const PolygonMesh& mesh,
                                                                     const Topology& topology, const Points& positions,
                                                                     Index v)
{
    Point product = Point::Zero();
    const Point here = positions.row(v);
    const double mass = visit_row(kernel, mesh, topology, positions, v,
                                  [&](Index w, double k) { product += k * (positions.row(w) - here); });
    return product / mass;
}

/// ΔV at a vertex for Δ_P: the sum of the shares of its corners, over M_v.
template <class Kernel>
Point curvature_by(Kernel, const PolygonMesh& mesh, const Topology& topology, const Points& positions, Index v)
{
    const auto area_of = [&](Index f) { return area(mesh.face(f), positions); };
    const auto flux_map_of = [&](Index f) -> Eigen::Matrix3d {
        return Kernel::flux_map(mesh.face(f), positions, positions, area_of(f));
    };
    Point product = Point::Zero();
    double mass = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[corner];
        product += Kernel::corner_share(mesh, topology, positions, f, flux_map_of);
        mass += corner_area(area_of(f), mesh.face(f).size());
    }
    return product / mass;
}

}  // namespace

Point mean_curvature_vector(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                            const ScaledLaplacian& laplacian, Index v)
{
    return with_kernel(laplacian,
                       [&]<class Kernel>(Kernel kernel) { return curvature_by(kernel, mesh, topology, positions, v); });
}

}  // namespace seamflow
