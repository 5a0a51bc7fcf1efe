#include "solvers/conditions/adapted_ventcell.h"

#include "solvers/conditions/adapted_robin.h"

namespace seamflow {

namespace {

class AdaptedVentcell final : public TransmissionCondition {
  public:
    AdaptedVentcell(const SubMesh& sub_mesh, double q)
        : sub_mesh_(&sub_mesh)
        , robin_(sub_mesh)
        , q_(q)
    {
    }

    [[nodiscard]] const IndexLists& columns() const override { return robin_.columns(); }

    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override
    {
        robin_.begin_step(positions, other_side, time_step, p);
        dt_q_ = time_step * q_;
    }

    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override
    {
        robin_.left_hand_side(i, positions, row);
        if (dt_q_ != 0.0)
            add_tangential_derivative(robin_.stencils(), i, tangential_weights(*sub_mesh_, i, positions), dt_q_, row);
    }

    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points& other_side) const override
    {
        return robin_.right_hand_side(i, positions, other_side);
    }

  private:
    const SubMesh* sub_mesh_;
    AdaptedRobin robin_;
    double q_;
    double dt_q_ = 0.0;
};

}  // namespace

std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q)
{
    return std::make_unique<AdaptedVentcell>(sub_mesh, q);
}

}  // namespace seamflow
