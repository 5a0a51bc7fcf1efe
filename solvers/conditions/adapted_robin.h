#pragma once

#include <optional>
#include <vector>

#include "solvers/conditions/derivatives.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The adapted Robin condition of the paper (eq. 24 with q = 0):
///
/// \f[ (I + dt\, p\, \partial_{n_A})\, V_A^{k+1} = (I - dt\, p\, \partial_{n_B})\, V_B , \f]
///
/// with A the sub-mesh and B the complement fan, each with its own outward conormal, α and ‖N‖ from Vᵏ. In the paper
/// V_B is V_B^k. Where one of the two conormals does not exist, p counts as 0 and the vertex keeps its place.
class AdaptedRobin final : public TransmissionCondition {
  public:
    /// @param sub_mesh must outlive the condition.
    explicit AdaptedRobin(const SubMesh& sub_mesh);

    [[nodiscard]] const IndexLists& columns() const override { return stencils_.columns; }
    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override;
    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override;
    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points& other_side) const override;

    /// The stencils of the derivatives, whose columns are the condition's.
    [[nodiscard]] const DerivativeStencils& stencils() const { return stencils_; }

    /// Whether the two conormals at the i-th vertex exist, point away from each other, and belong to derivatives whose
    /// coefficients are in proportion to the edges around: otherwise the condition lets vertices jump.
    [[nodiscard]] bool is_well_defined(Index i, const Points& positions) const;

  private:
    /// Both sides at one vertex of Γ.
    struct Conormals {
        Conormal own;
        Conormal other;
    };

    const SubMesh* sub_mesh_;
    DerivativeStencils stencils_;
    double dt_p_ = 0.0;
    /// Per vertex of Γ; empty if one of them does not exist.
    std::vector<std::optional<Conormals>> conormals_;
};

}  // namespace seamflow
