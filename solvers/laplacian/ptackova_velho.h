#pragma once

#include <span>

#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// Δ_P = -W_V fvᵀ d1 A W1 Rᵀ d0 (paper, eq. 16). W1 Rᵀ d0 x is, for each half-edge h of a face, the flux w_h = ⟨e_h, Σₖ
/// bₖ xₖ⟩ / |f| of x across it (bₖ: see corner_bisector). The fluxes of one face sum to zero, so that A leaves per face
/// f: Φ_f = ½ (Σ over edges shared with a face g of w in g - Σ over edges without of w in f), and Δ_P x = W_V fvᵀ Φ.
/// Its rows reach two rings: the rows at the corners of a face depend on the faces across its edges, too.
struct PtackovaVelho {
    static constexpr LaplacianTraits traits{Laplacian::PtackovaVelho, "ptackova-velho",   "Δ_P",
                                            Reach::TwoRings,          Divisor::FaceAreas, false};

    /// The half-edge whose flux counts at an edge of a face, and the sign of the flux.
    struct Across {
        Index halfedge;
        double sign;
    };

    /// The half-edge on the other side of the edge; on the boundary the face's own half-edge, with the opposite sign.
    static Across across(Index halfedge, Index twin) { return twin >= 0 ? Across{twin, 1.0} : Across{halfedge, -1.0}; }

    /// ± ½ w_h as a row: its coefficient at a corner k of the face of h is the scalar product with bₖ.
    static Point half_flux(const Point& edge, double sign, double face_area) { return sign * 0.5 / face_area * edge; }

    /// Σₖ bₖᵀ xₖ / |f|: the map from e_h to w_h for given x.
    /// @param positions at least #V by 3, with which b is computed. @param x at least #V by 3.
    static Eigen::Matrix3d flux_map(std::span<const Index> corners, const Points& positions, const Points& x,
                                    double face_area)
    {
        const Point origin = x.row(corners[0]);
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (std::size_t k = 1; k < corners.size(); ++k)
            sum += corner_bisector(corners, k, positions).transpose() * (x.row(corners[k]) - origin);
        return sum / face_area;
    }

    /// Φ_f / p, the share of each of the p corners of f in M Δ_P x.
    /// @param flux_map_of the flux map of any face next to f, and of f itself on the boundary.
    template <class FluxMapOf>
    static Point corner_share(const PolygonMesh& mesh, const Topology& topology, const Points& positions, Index f,
                              FluxMapOf&& flux_map_of)
    {
        Point sum = Point::Zero();
        for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
            const auto [across_h, sign] = across(h, topology.twin[h]);
            const Point edge = positions.row(mesh.face_vertices[topology.next(mesh, across_h)]) -
                               positions.row(mesh.face_vertices[across_h]);
            const Point flux = edge * flux_map_of(topology.face_of[across_h]);
            sum += sign * flux;
        }
        return sum / (2.0 * static_cast<double>(mesh.face(f).size()));
    }
};

}  // namespace seamflow
