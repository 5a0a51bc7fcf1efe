#pragma once

#include "partition/topology.h"
#include "solvers/laplacian/kernels.h"

/// The row of one vertex of the whole mesh in a Laplacian M⁻¹ K, without a matrix.
namespace seamflow {

/// Calls entry(w, k) for the neighbours w of v, perhaps several times for one: K_vw is the sum of its k. The row of K
/// sums to zero.
/// @param positions #V by 3.
/// @returns M_v.
template <EdgeKernel Kernel, class Entry>
double visit_row(Kernel kernel, const PolygonMesh& mesh, const Topology& topology, const Points& positions, Index v,
                 Entry&& entry)
{
    // If faces are oriented alike, exactly one half-edge of each edge at an interior vertex begins there: they visit
    // each edge once. Elsewhere the half-edges before and after each corner are visited, with half the weight of their
    // edge.
    const bool once = topology.oriented && topology.kind[v] == VertexKind::Interior;
    const double share = once ? 1.0 : 0.5;
    const Point here = positions.row(v);
    double mass = 0.0;
    double degree = 0.0;
    const auto visit = [&](Index end) {
        const Index w = mesh.face_vertices[end];
        const auto edge = kernel.edge(here - positions.row(w));
        entry(w, -edge.weight(share));
        mass += share * edge.mass();
        degree += share;
    };
    for (const Index corner : topology.corners_at(v)) {
        visit(topology.next(mesh, corner));
        if (!once)
            visit(topology.previous(mesh, corner));
    }
    return Kernel::averages_mass ? mass / degree : mass;
}

/// The same for a Laplacian that is a sum over faces.
template <FaceKernel Kernel, class Entry>
double visit_row(Kernel, const PolygonMesh& mesh, const Topology& topology, const Points& positions, Index v,
                 Entry&& entry)
{
    double mass = 0.0;
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[corner];
        measure_corner<Kernel>(mesh.face(f), usize(corner - mesh.face_offsets[f]), positions,
                               [&](const auto& face, std::size_t i) {
                                   const auto row = face.row(i, 1.0 / face.divisor());
                                   for (std::size_t k = 0; k < face.size(); ++k)
                                       if (k != i)
                                           entry(face.corner(k), row(k));
                                   mass += face.mass(i);
                               });
    }
    return mass;
}

}  // namespace seamflow
