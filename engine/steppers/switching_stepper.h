#pragma once

#include <memory>
#include <span>

#include "engine/setup/way_of_steps.h"
#include "engine/steppers/conjugate_gradient_stepper.h"
#include "engine/steppers/stepper.h"

namespace seamflow {

/// Takes undecomposed steps by conjugate gradients. From some step on, these begin with the solution by a factorisation
/// of the whole mesh: as soon as they need so many iterations that factorising is cheaper for further steps. Edges that
/// a flow shrinks to nothing make the matrix worse, which no choice before the first step foresees; if they also spoil
/// the factorisation, conjugate gradients correct its solution or do without it. The decisions depend on numbers of
/// iterations alone, so that the bits are the same on every machine with enough memory.
class SwitchingStepper final : public Stepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper.
    /// @param settings without a filter. @param gradients with costs.
    SwitchingStepper(const PolygonMesh& mesh, const Topology& topology, const StepSettings& settings,
                     const GradientSteps& gradients, Progress& progress);

    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return gradients_.positions(); }
    void set_positions(const Points& image, const SimilarityOfComponents& similarity) override;
    void set_vertices(std::span<const Index> vertices, const Points& to) override
    {
        gradients_.set_vertices(vertices, to);
    }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void add_seconds(PhaseSeconds& seconds) const override;
    void report_to(StepReport& report) const override { gradients_.report_to(report); }
    void report_to(FlowReport& report) const override;

  private:
    void make_factors();
    void try_to_make_factors();
    void leave_factors();
    const Points* solve_by_factors(const Points& before);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    StepSettings settings_;
    FlowSize size_;
    Progress* progress_;
    ConjugateGradientStepper gradients_;
    /// The topology with twins, which the factorisation needs; empty until there is a factorisation.
    Topology complete_;
    std::unique_ptr<Stepper> factors_;
    /// The iterations of the last two steps without factors.
    StepIterations iterations_;
    int n_taken_ = 0;
    /// The number of the step for which factors were first made, or failed to be made; 0: none.
    int first_with_factors_ = 0;
    /// The number of the step in which factorising, or a solution by the factors, failed; 0: none.
    int failed_ = 0;
};

}  // namespace seamflow
