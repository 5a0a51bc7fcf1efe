#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solvers/conditions/derivatives.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The positions on Γ for which a right-hand side is computed.
enum class RightSide {
    /// The sub-mesh's own positions.
    Own,
    /// The copy of Γ of the sub-mesh on the other side, with the tangential derivative along it.
    OthersCopy,
};

/// The adapted conditions of the paper (eq. 24), Robin's with q = 0:
///
/// \f[ (I + dt\, (p\, \partial_{n_A} + q\, \partial_t))\, V_A^{k+1} = (I - dt\, p\, \partial_{n_B})\, V_B , \f]
///
/// with A the sub-mesh and B the complement fan, each with its own outward conormal, α and ‖N‖ from Vᵏ. In the paper
/// V_B is V_B^k. Where one of the two conormals does not exist, p counts as 0; with q = 0 and RightSide::Own, the
/// vertex then does not move. With RightSide::OthersCopy, these are the classical conditions (see make_ventcell).
class AdaptedRobin final : public TransmissionCondition {
  public:
    /// @param sub_mesh must outlive the condition. @param q at least 0, without dimension.
    explicit AdaptedRobin(const SubMesh& sub_mesh, double q = 0.0, RightSide right_side = RightSide::Own);

    [[nodiscard]] const IndexLists& columns() const override { return stencils_.columns; }
    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override;
    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override;
    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points& other_side) const override;

    /// The stencils of the derivatives, whose columns are the condition's.
    [[nodiscard]] const DerivativeStencils& stencils() const { return stencils_; }

    /// Whether the condition can be used at the i-th vertex: the two conormals exist and point away from each other,
    /// the two neighbours along Γ are not too near each other, and both sides have derivatives whose coefficients are
    /// in proportion to the edges around. Otherwise the condition would let the vertex jump.
    [[nodiscard]] bool is_well_defined(Index i, const Points& positions) const;

  private:
    /// The conormals of both sides at one vertex of Γ.
    struct Conormals {
        Conormal own;
        Conormal other;
    };

    const SubMesh* sub_mesh_;
    double q_;
    RightSide right_side_;
    DerivativeStencils stencils_;
    double dt_p_ = 0.0;
    double dt_q_ = 0.0;
    /// Per vertex of Γ; empty if one of the two conormals does not exist.
    std::vector<std::optional<Conormals>> conormals_;
    /// Per vertex of Γ, the weights along the copy of Γ of the other side.
    std::vector<TangentialWeights> others_weights_;
};

/// The adapted Ventcell condition of the paper (eq. 24), with the tangential derivative along Γ, for the lengths of
/// edges in Vᵏ. The condition straightens Γ.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q = 0.0);

/// The classical Ventcell condition (paper, eqs. 20 and 21): (I + dt (p ∂n + q ∂t)) V_A^{k+1} = (I + dt (p ∂n + q ∂t))
/// V_B, with V_B the other side's own copy of Γ and the vertices beyond. n is A's outward conormal; on the right-hand
/// side, the opposite of B's outward conormal replaces it, so that a flat mesh stays as it is. The tangential
/// derivative is taken along either side's own copy of Γ, for the lengths of edges in Vᵏ. Otherwise as AdaptedRobin;
/// with q = 0 the classical Robin condition.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q = 0.0);

}  // namespace seamflow
