#include <memory>
#include <memory_resource>
#include <optional>

#include "samples/benchmark/methods/peer_solver.h"
#include "solvers/direct/suitesparse.h"

namespace seamflow {

namespace {

/// LU of the whole mesh with the settings that sub-meshes use: symmetric strategy, AMD, no iterative refinement, and
/// 64-bit integers above 100,000 unknowns.
class WholeUmfpack final : public PeerSolver {
  public:
    [[nodiscard]] SystemForm form() const override { return SystemForm::AsTheyStand; }
    [[nodiscard]] StorageOrder order() const override { return StorageOrder::ByColumns; }
    void analyse(const WholeSystem& system) override { solver_ = make_umfpack_lu(system.pattern()); }
    void prepare(const WholeSystem& system) override
    {
        factor_.reset();
        factor_ = solver_->factorise(system.values(), *std::pmr::new_delete_resource(), workspace_);
    }

    int solve(const WholeSystem& system, Columns& solution) override
    {
        factor_->solve(system.right_hand_side(), solution, workspace_);
        return 0;
    }

  private:
    SolverWorkspace workspace_;
    std::unique_ptr<DirectSolver> solver_;
    std::optional<DirectSolver::Factor> factor_;
};

}  // namespace

std::unique_ptr<PeerSolver> make_umfpack_solver()
{
    return std::make_unique<WholeUmfpack>();
}

}  // namespace seamflow
