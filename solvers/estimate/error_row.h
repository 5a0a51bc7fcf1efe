#pragma once

#include <cstdint>
#include <span>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Kind of a neighbour of a vertex of Γ that is not itself on Γ (see error_row).
inline constexpr Index off_interface = -1;
inline constexpr Index held_fixed = -2;

/// One row of the equation T e = r for the error e that a decomposed step has on Γ. With the rows of the undecomposed
/// step in symmetric form, M (Vᵏ⁺¹ - Vᵏ) + dt K Vᵏ⁺¹ = 0, the residual r is their left-hand side at the result of the
/// sweep. T is M + dt K on Γ, and what lies beyond Γ responds as in a half plane: at distance d from Γ, e^-θ of the
/// error is left, cosh θ = 1 + d² / 2 dt D, where D is the diffusivity of the row itself. Positive definite: negative
/// couplings count as none.
struct ErrorRow {
    /// M_v: in length for Δ_F, in length² for the others.
    double mass = 0.0;
    /// T_vv.
    double diagonal = 0.0;
    /// The response of the vertices beyond Γ, in the unit of T: what is left of their coupling.
    double response = 0.0;
    Point residual = Point::Zero();
    /// Unit normal of the surface at Vᵏ, for Δ_F of the sub-mesh's own side; zero where it has none.
    Point normal = Point::Zero();
};

/// A step of a sub-mesh, #local by 3 each, the halo included.
struct SolvedStep {
    /// Vᵏ, and Vᵏ⁺¹ as solved.
    const Points& before;
    const Points& after;
    /// The positions whose K the step uses; Vᵏ if K is not kept.
    const Points& stiffness_at;
    /// dt, in length².
    double time_step;
};

/// The row at the i-th vertex of a sub-mesh's Γ. Δ_P has the T of Δ_A, and no residual here: its rows reach further.
/// @param senses one per face around the vertex, first its own ones, then those of the complement fan: 1, or -1 if the
///        face is oriented against the others (see VertexNormals::sense). Empty: 1 everywhere.
/// @param kinds one per edge neighbour of the vertex (see CorrectedVertices): its number on Γ, or one of the above.
/// @param couplings one per edge neighbour: receives -T_vw where it is on Γ, and else 0.
ErrorRow error_row(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, Index i,
                   std::span<const std::int8_t> senses, std::span<const Index> kinds, const SolvedStep& step,
                   std::span<double> couplings);

}  // namespace seamflow
