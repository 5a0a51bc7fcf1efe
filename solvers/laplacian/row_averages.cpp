#include "solvers/laplacian/row_averages.h"

#include <algorithm>
#include <cmath>

#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

constexpr Index sample_size = 8192;

/// A row of M⁻¹ K at an interior vertex.
template <EdgeKernel Kernel>
RowAverages row_at(Kernel kernel, const PolygonMesh& mesh, const Topology& topology, Index v)
{
    double stiffness = 0.0;
    double mass = 0.0;
    const std::span<const Index> corners = topology.corners_at(v);
    // Each edge is met twice, which is half of each of stiffness and mass.
    for (const Index corner : corners)
        for (const Index end : {topology.next(mesh, corner), topology.previous(mesh, corner)}) {
            const auto edge = kernel.edge(mesh.vertices.row(v) - mesh.vertices.row(mesh.face_vertices[end]));
            stiffness += 0.5 * edge.weight(1.0);
            mass += 0.5 * edge.mass();
        }
    const auto degree = static_cast<double>(corners.size());
    return {degree, (Kernel::averages_mass ? degree : 1.0) * stiffness / mass};
}

template <FaceKernel Kernel>
RowAverages row_at(Kernel, const PolygonMesh& mesh, const Topology& topology, Index v)
{
    double length = 0.0;
    double stiffness = 0.0;
    double mass = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[corner];
        const auto place = static_cast<std::size_t>(corner - mesh.face_offsets[f]);
        measure_corner<Kernel>(mesh.face(f), place, mesh.vertices, [&](const auto& face, std::size_t i) {
            stiffness += face.row(i, 1.0 / face.divisor())(i);
            mass += face.mass(i);
            // The other end of each edge at the vertex is in two faces.
            length += static_cast<double>(face.size()) - 2.0;
        });
    }
    return {length, stiffness / mass};
}

}  // namespace

RowAverages average_rows(const PolygonMesh& mesh, const Topology& topology, const ScaledLaplacian& laplacian)
{
    RowAverages sum;
    double n = 0.0;
    with_kernel(laplacian, [&]<class Kernel>(Kernel kernel) {
        if constexpr (EdgeKernel<Kernel> || FaceKernel<Kernel>) {
            for (Index v = 0; v < mesh.n_vertices(); v += std::max(mesh.n_vertices() / sample_size, Index{1})) {
                if (!topology.moves(v) || topology.kind[v] != VertexKind::Interior)
                    continue;
                const RowAverages row = row_at(kernel, mesh, topology, v);
                if (!std::isfinite(row.stiffness))
                    continue;
                sum.length += row.length;
                sum.stiffness += row.stiffness;
                n += 1.0;
            }
        } else {
            throw OptionError("the Laplacian is not symmetric");
        }
    });
    return n > 0.0 ? RowAverages{sum.length / n, sum.stiffness / n} : RowAverages{};
}

}  // namespace seamflow
