#include "solvers/conditions/ventcell.h"

#include <vector>

#include "solvers/conditions/adapted_ventcell.h"
#include "solvers/conditions/derivatives.h"

namespace seamflow {

namespace {

/// The adapted condition's row; but on the right stands the other side's copy of Γ instead of one's own, with its
/// tangential derivative.
class Ventcell final : public TransmissionCondition {
  public:
    Ventcell(const SubMesh& sub_mesh, double q)
        : sub_mesh_(&sub_mesh)
        , adapted_(make_adapted_ventcell(sub_mesh, q))
        , q_(q)
        , others_weights_(sub_mesh.interface.size())
    {
    }

    [[nodiscard]] const IndexLists& columns() const override { return adapted_->columns(); }

    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override
    {
        adapted_->begin_step(positions, other_side, time_step, p);
        dt_q_ = time_step * q_;
        for (Index i = 0; i < sub_mesh_->interface.size(); ++i)
            others_weights_[i] = tangential_weights(*sub_mesh_, i, other_side);
    }

    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override
    {
        adapted_->left_hand_side(i, positions, row);
    }

    [[nodiscard]] Point right_hand_side(Index i, const Points&, const Points& other_side) const override
    {
        const Point robin = adapted_->right_hand_side(i, other_side, other_side);
        if (dt_q_ == 0.0)
            return robin;
        return robin + dt_q_ * tangential_derivative(*sub_mesh_, i, others_weights_[i], other_side);
    }

  private:
    const SubMesh* sub_mesh_;
    std::unique_ptr<TransmissionCondition> adapted_;
    double q_;
    double dt_q_ = 0.0;
    /// Per vertex of Γ, of the other side's copy.
    std::vector<TangentialWeights> others_weights_;
};

}  // namespace

std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<Ventcell>(sub_mesh, q);
}

}  // namespace seamflow
