#pragma once

#include <optional>
#include <span>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

/// The stencil of a derivative at each vertex of a sub-mesh's Γ: the vertices of the sub-mesh's own faces at this
/// vertex.
struct DerivativeStencils {
    /// Per vertex of Γ: the vertices of the stencil, ascending.
    IndexLists columns;
    /// Per vertex of Γ: the indices in `columns` of the corners of the own faces at the vertex, face after face.
    IndexLists corner_columns;
    /// Per vertex of Γ: the indices in `columns` of the vertex itself and of its two neighbours along the boundary.
    std::vector<Index> centre;
    std::vector<Index> before;
    std::vector<Index> after;
};

/// The stencils of all vertices of Γ.
DerivativeStencils make_derivative_stencils(const SubMesh& sub_mesh);

/// The outward conormal N / ‖N‖ of a fan of faces at the i-th vertex of Γ (paper, Definition newNormalDerivative), with
/// N = S - ατ, S = Σ_f (v - c_f), c_f being the centroid of face f, τ = v_after - v_before, α = ⟨S, τ⟩ / ⟨τ, τ⟩.
struct Conormal {
    double alpha = 0.0;
    /// ‖N‖, in length.
    double norm = 0.0;
    /// N / ‖N‖.
    Point direction = Point::Zero();
};

/// The conormal of the sub-mesh's own side. Empty where it does not exist: N vanishes to rounding.
/// @param positions #local by 3, the halo included.
std::optional<Conormal> own_conormal(const SubMesh& sub_mesh, Index i, const Points& positions);

/// The conormal of the other side, which is the conormal of the complement fan.
std::optional<Conormal> complement_conormal(const SubMesh& sub_mesh, Index i, const Points& positions);

/// The row of ∂n at the i-th vertex of Γ, linear in the positions because α and ‖N‖ are constants: (Σ_f (e_i - Σ_{k∈f}
/// e_k / p_f) - α (e_after - e_before)) / ‖N‖, in 1/length, with e_i the unit row of vertex i and p_f the number of
/// corners of f. Applied to the positions from which the conormal was computed, the row gives the conormal.
/// @param row receives one coefficient per vertex of the stencil.
void normal_derivative_row(const SubMesh& sub_mesh, const DerivativeStencils& stencils, Index i,
                           const Conormal& conormal, std::span<double> row);

/// ∂n of the other side at the i-th vertex of Γ, applied to positions, with constant α and ‖N‖ as in
/// normal_derivative_row. Without dimension.
/// @param other_side #local by 3, the halo included.
Point complement_normal_derivative(const SubMesh& sub_mesh, Index i, const Conormal& conormal,
                                   const Points& other_side);

/// The weights of ∂t at a vertex v of Γ, in 1/length² (paper, eq. 23): ∂t = before (v - v_before) +
/// after (v - v_after), with before = 2 / (l₁ + l₂) / l₁ and after = 2 / (l₁ + l₂) / l₂.
struct TangentialWeights {
    double before = 0.0;
    double after = 0.0;
};

/// The weights at the i-th vertex of Γ, with l₁ and l₂ the lengths of its two edges along Γ.
TangentialWeights tangential_weights(const SubMesh& sub_mesh, Index i, const Points& positions);

/// Adds a multiple of the row of ∂t at the i-th vertex of Γ, with constant weights.
/// @param row one coefficient per vertex of the stencil.
void add_tangential_derivative(const DerivativeStencils& stencils, Index i, const TangentialWeights& weights,
                               double factor, std::span<double> row);

/// ∂t at the i-th vertex of Γ, applied to positions, with constant weights. In 1/length.
Point tangential_derivative(const SubMesh& sub_mesh, Index i, const TangentialWeights& weights,
                            const Points& positions);

}  // namespace seamflow
