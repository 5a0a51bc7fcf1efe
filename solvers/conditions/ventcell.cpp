#include "solvers/conditions/ventcell.h"

#include <vector>

#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/derivatives.h"

namespace seamflow {

namespace {

/// The positions on Γ for which the right-hand side is computed.
enum class RightSide {
    /// The sub-mesh's own.
    Own,
    /// The other side's copy, with its tangential derivative.
    OthersCopy,
};

class Ventcell final : public TransmissionCondition {
  public:
    Ventcell(const SubMesh& sub_mesh, double q, RightSide right_side)
        : sub_mesh_(&sub_mesh)
        , robin_(sub_mesh)
        , q_(q)
        , right_side_(right_side)
        , others_weights_(sub_mesh.interface.size())
    {
    }

    [[nodiscard]] const IndexLists& columns() const override { return robin_.columns(); }

    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override
    {
        robin_.begin_step(positions, other_side, time_step, p);
        dt_q_ = time_step * q_;
        if (dt_q_ != 0.0 && right_side_ == RightSide::OthersCopy)
            for (Index i = 0; i < sub_mesh_->interface.size(); ++i)
                others_weights_[i] = tangential_weights(*sub_mesh_, i, other_side);
    }

    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override
    {
        robin_.left_hand_side(i, positions, row);
        if (dt_q_ != 0.0)
            add_tangential_derivative(robin_.stencils(), i, tangential_weights(*sub_mesh_, i, positions), dt_q_, row);
    }

    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points& other_side) const override
    {
        if (right_side_ == RightSide::Own)
            return robin_.right_hand_side(i, positions, other_side);
        const Point robin = robin_.right_hand_side(i, other_side, other_side);
        if (dt_q_ == 0.0)
            return robin;
        return robin + dt_q_ * tangential_derivative(*sub_mesh_, i, others_weights_[i], other_side);
    }

  private:
    const SubMesh* sub_mesh_;
    AdaptedRobin robin_;
    double q_;
    double dt_q_ = 0.0;
    RightSide right_side_;
    /// Per vertex of Γ, of the other side's copy.
    std::vector<TangentialWeights> others_weights_;
};

}  // namespace

std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<Ventcell>(sub_mesh, q, RightSide::Own);
}

std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<Ventcell>(sub_mesh, q, RightSide::OthersCopy);
}

}  // namespace seamflow
