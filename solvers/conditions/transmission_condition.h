#pragma once

#include <span>

#include "partition/index_lists.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

/// The rows of a sub-mesh at those vertices of its Γ where it leads. They stand for the sub-meshes on the other side,
/// of which only the latest state is known: Vᵏ, a prediction, or, where every sub-mesh has its own copy of Γ, their
/// copies. Vertices are local, row i is that of the i-th vertex of Γ (see SubMeshInterface).
class TransmissionCondition {
  public:
    virtual ~TransmissionCondition() = default;

    /// The own vertices on which each row may depend, the vertex itself among them; ascending, the same in every step.
    [[nodiscard]] virtual const IndexLists& columns() const = 0;

    /// Reads the geometry of a new step; to be called before left_hand_side and right_hand_side.
    /// @param positions #local by 3, the halo included: Vᵏ.
    /// @param other_side #local by 3: Vᵏ of the sub-meshes on the other side, on Γ and in the halo.
    /// @param time_step dt, in length².
    /// @param p Robin parameter, in 1/length.
    virtual void begin_step(const Points& positions, const Points& other_side, double time_step, double p) = 0;

    /// The left-hand side of row i.
    /// @param row receives one coefficient per entry of columns()[i].
    virtual void left_hand_side(Index i, const Points& positions, std::span<double> row) const = 0;

    /// The right-hand side of row i, linear in both arguments: with data in place of positions, it is the right-hand
    /// side of the data for the same geometry.
    /// @param positions #local by 3: Vᵏ.
    /// @param other_side #local by 3: the latest known Vᵏ⁺¹ of the sub-meshes on the other side, on Γ and in the halo.
    [[nodiscard]] virtual Point right_hand_side(Index i, const Points& positions, const Points& other_side) const = 0;
};

}  // namespace seamflow
