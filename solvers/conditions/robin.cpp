#include "solvers/conditions/robin.h"

#include "solvers/conditions/adapted_robin.h"

namespace seamflow {

namespace {

/// The adapted condition's row; but on the right stands the other side's copy of Γ instead of one's own.
class Robin final : public TransmissionCondition {
  public:
    explicit Robin(const SubMesh& sub_mesh)
        : adapted_(sub_mesh)
    {
    }

    [[nodiscard]] const IndexLists& columns() const override { return adapted_.columns(); }

    void begin_step(const Points& positions, const Points& other_side, double time_step, double p) override
    {
        adapted_.begin_step(positions, other_side, time_step, p);
    }

    void left_hand_side(Index i, const Points& positions, std::span<double> row) const override
    {
        adapted_.left_hand_side(i, positions, row);
    }

    [[nodiscard]] Point right_hand_side(Index i, const Points&, const Points& other_side) const override
    {
        return adapted_.right_hand_side(i, other_side, other_side);
    }

  private:
    AdaptedRobin adapted_;
};

}  // namespace

std::unique_ptr<TransmissionCondition> make_robin(const SubMesh& sub_mesh)
{
    return std::make_unique<Robin>(sub_mesh);
}

}  // namespace seamflow
