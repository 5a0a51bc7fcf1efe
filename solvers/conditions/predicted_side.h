#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Whether the row at the i-th vertex of Γ is that of the undecomposed step with the other side responding (see
/// make_predicted_side): where the Laplacian reaches along edges alone, and Δ_A and Δ_B where all faces at the vertex
/// are triangles.
bool responds_at(const SubMesh& sub_mesh, Laplacian laplacian, Index i);

/// Robin conditions with a prediction of the other side: positions Ŵ of its vertices for Γ held at Vᵏ. The movement of
/// Γ then acts on the other side as a disturbance that dies away over √dt.
///
/// Where the Laplacian allows (it reaches along edges alone: Δ_F, Laplacian::Fujiwara, and Δ_U, Laplacian::Uniform;
/// Δ_A, Laplacian::AlexaWardetzky, and Δ_B, Laplacian::VirtualRefinement, where all faces at the vertex are triangles)
/// the row is that of the undecomposed step, V_v + dt Σⱼ aⱼ Vⱼ = V_v^k, a being the row of the Laplacian, with each
/// vertex w beyond Γ replaced by Ŵ_w + ρ_w (V_v - V_v^k), its response to Γ. ρ = e^{-θ}, cosh θ = 1 + d² / (2 dt), is
/// the fraction of a disturbance that is left at distance d (see remainder_between). Such a row is a Robin condition
/// with the coefficient 1/√dt, whose derivative has the form of the Laplacian itself. Where the responses would make
/// the diagonal of the Laplacian negative (obtuse triangles), there are none: Ŵ stays as it is. Elsewhere the row is
/// that of AdaptedRobin, and where this is not well defined, the row of the undecomposed step with Ŵ as it is (with the
/// rows of Δ_A for Δ_P, Laplacian::PtackovaVelho).
/// @param sub_mesh must outlive the condition.
/// @param stiffness_at #local by 3, the halo included: positions whose K is kept; nullptr: K follows the mesh. Needed
/// only during the call.
std::unique_ptr<TransmissionCondition> make_predicted_side(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian,
                                                           const Points* stiffness_at = nullptr);

}  // namespace seamflow
