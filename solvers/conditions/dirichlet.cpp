#include "solvers/conditions/dirichlet.h"

namespace seamflow {

namespace {

/// Rows of the identity (see make_dirichlet).
class Dirichlet final : public TransmissionCondition {
  public:
    explicit Dirichlet(const SubMesh& sub_mesh)
    {
        for (const Index v : sub_mesh.interface.vertices) {
            columns_.values.push_back(v);
            columns_.close();
        }
    }

    [[nodiscard]] const IndexLists& columns() const override { return columns_; }
    void begin_step(const Points&, const Points&, double, double) override {}
    void left_hand_side(Index, const Points&, std::span<double> row) const override { row[0] = 1.0; }

    [[nodiscard]] Point right_hand_side(Index i, const Points& positions, const Points&) const override
    {
        return positions.row(columns_[i][0]);
    }

  private:
    IndexLists columns_;
};

}  // namespace

std::unique_ptr<TransmissionCondition> make_dirichlet(const SubMesh& sub_mesh)
{
    return std::make_unique<Dirichlet>(sub_mesh);
}

}  // namespace seamflow
