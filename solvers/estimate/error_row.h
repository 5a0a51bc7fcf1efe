#pragma once

#include <cstdint>
#include <span>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The kind of a neighbour that is not on Γ, or that is fixed (see error_row).
inline constexpr Index off_interface = -1;
inline constexpr Index fixed_vertex = -2;

/// One row of the equation T e = r for the error e that a decomposed step has on Γ. The rows of the undecomposed step
/// in symmetric form are M (Vᵏ⁺¹ - Vᵏ) + dt K Vᵏ⁺¹ = 0; the residual r is their left-hand side at the result of the
/// sweep. T is M + dt K on Γ, with a response of the vertices beyond Γ as in a half plane: at distance d from Γ, the
/// fraction e^-θ of the error is left, cosh θ = 1 + d² / (2 dt D), D being the diffusivity of the row itself. T is
/// positive definite: negative couplings count as 0.
struct ErrorRow {
    /// M_v: in length or length² (see LaplacianTraits::mass_is_length).
    double mass = 0.0;
    /// T_vv.
    double diagonal = 0.0;
    /// The response of the vertices beyond Γ, in the unit of T: the sum of their couplings, each times e^-θ.
    double response = 0.0;
    Point residual = Point::Zero();
    /// The unit normal of the surface at Vᵏ, with Δ_F and Δ_U (Laplacian::Uniform) the normal of the sub-mesh's own
    /// side; zero where the surface has none.
    Point normal = Point::Zero();
};

/// A step of a sub-mesh. Each array is #local by 3, the halo included.
struct SolvedStep {
    /// Vᵏ, and Vᵏ⁺¹ as solved.
    const Points& before;
    const Points& after;
    /// The positions from which the step has K: Vᵏ, or V⁰ if K is kept.
    const Points& stiffness_at;
    /// dt, in length².
    double time_step;
};

/// The row at the i-th vertex of a sub-mesh's Γ. For Δ_P (Laplacian::PtackovaVelho), T is that of Δ_A
/// (Laplacian::AlexaWardetzky), and the residual is 0: rows of Δ_P reach beyond the halo.
/// @param senses one per face around the vertex, first the sub-mesh's own faces, then those of the complement fan: 1,
/// or -1 if the face is oriented against the others (see VertexNormals::sense). Empty: 1 everywhere.
/// @param kinds one per edge neighbour of the vertex (see CorrectedVertices): its number on Γ, off_interface or
/// fixed_vertex.
/// @param couplings one per edge neighbour: receives -T_vw where the neighbour is on Γ, and 0 elsewhere.
ErrorRow error_row(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian, Index i,
                   std::span<const std::int8_t> senses, std::span<const Index> kinds, const SolvedStep& step,
                   std::span<double> couplings);

}  // namespace seamflow
