#include "solvers/laplacian/mean_curvature.h"

#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// A mesh at certain positions.
struct Surface {
    const PolygonMesh& mesh;
    const Topology& topology;
    const Points& positions;

    [[nodiscard]] Index face_at(Index corner) const { return topology.face_of[corner]; }
};

template <EdgeKernel Kernel>
Point curvature_by(Kernel kernel, const Surface& s, Index v)
{
    Point product = Point::Zero();
    double degree = 0.0;
    double mass = 0.0;
    const Point here = s.positions.row(v);
    // Where faces are oriented alike, each edge of an interior vertex begins one of its half-edges. Elsewhere those of
    // two faces are met twice, which is half of each of degree, mass and product.
    const bool once = s.topology.oriented && s.topology.kind[v] == VertexKind::Interior;
    const auto add = [&](Index end) {
        const Point difference = here - s.positions.row(s.mesh.face_vertices[end]);
        const auto edge = kernel.edge(difference);
        product += edge.weight(1.0) * difference;
        mass += edge.mass();
        degree += 1.0;
    };
    for (const Index corner : s.topology.corners_at(v)) {
        add(s.topology.next(s.mesh, corner));
        if (!once)
            add(s.topology.previous(s.mesh, corner));
    }
    return Kernel::averages_mass ? Point((degree / mass) * (once ? 1.0 : 0.5) * product) : Point(product / mass);
}

template <FaceKernel Kernel>
Point curvature_by(Kernel, const Surface& s, Index v)
{
    Point product = Point::Zero();
    double mass = 0.0;
    for (const Index corner : s.topology.corners_at(v)) {
        const Index f = s.face_at(corner);
        const auto own = at(corner - s.mesh.face_offsets[f]);
        measure_corner<Kernel>(s.mesh.face(f), own, s.positions, [&](const auto& face, std::size_t i) {
            const auto row = face.row(i, 1.0);
            Point sum = Point::Zero();
            for (std::size_t k = 1; k < face.size(); ++k)
                sum += row(k) * face.difference(0, k);
            product += face.divided(sum);
            mass += face.mass(i);
        });
    }
    return product / mass;
}

/// For Δ_P.
template <class Kernel>
Point curvature_by(Kernel, const Surface& s, Index v)
{
    const auto area_of = [&](Index f) { return area(s.mesh.face(f), s.positions); };
    const auto flux_map_of = [&](Index f) -> Eigen::Matrix3d {
        return Kernel::flux_map(s.mesh.face(f), s.positions, s.positions, area_of(f));
    };
    Point product = Point::Zero();
    double mass = 0.0;
    for (const Index corner : s.topology.corners_at(v)) {
        const Index f = s.face_at(corner);
        product += Kernel::corner_share(s.mesh, s.topology, s.positions, f, flux_map_of);
        mass += corner_area(area_of(f), s.mesh.face(f).size());
    }
    return product / mass;
}

}  // namespace

Point mean_curvature_vector(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                            const ScaledLaplacian& laplacian, Index v)
{
    return with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) {
        return curvature_by(kernel, Surface{mesh, topology, positions}, v);
    });
}

}  // namespace seamflow
