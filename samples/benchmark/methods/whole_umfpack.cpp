#include <optional>

#include "samples/benchmark/methods/peer_solver.h"
#include "solvers/direct/umfpack_solver.h"

namespace seamflow {

namespace {

/// LU of the whole mesh with the settings that sub-meshes use: symmetric strategy, AMD, no iterative refinement, and
/// 64-bit integers above 100,000 unknowns.
class WholeUmfpack final : public PeerSolver {
  public:
    [[nodiscard]] SystemForm form() const override { return SystemForm::AsTheyStand; }
    [[nodiscard]] StorageOrder order() const override { return StorageOrder::ByColumns; }
    void analyse(const WholeSystem& system) override { solver_.emplace(system.pattern()); }
    void prepare(const WholeSystem& system) override { solver_->factorise(system.values()); }

    int solve(const WholeSystem& system, Columns& solution) override
    {
        solver_->solve(system.values(), system.right_hand_side(), solution);
        return 0;
    }

  private:
    std::optional<UmfpackSolver> solver_;
};

}  // namespace

std::unique_ptr<PeerSolver> make_umfpack_solver()
{
    return std::make_unique<WholeUmfpack>();
}

}  // namespace seamflow
