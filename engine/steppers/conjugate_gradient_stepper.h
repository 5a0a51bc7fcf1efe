#pragma once

#include "engine/steppers/converged_stepper.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/systems/whole_mesh_system.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step of a symmetric Laplacian by conjugate gradients on the whole mesh, whose
/// rows the threads share (see WholeMeshSystem): no cut, no factorisation, hardly any set-up. Fastest for short steps,
/// and for few steps.
class ConjugateGradientStepper final : public ConvergedStepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper.
    /// @param given K and M of a linear flow in place of those of the Laplacian, which must outlive the stepper; null:
    ///        none.
    ConjugateGradientStepper(const PolygonMesh& mesh, const Topology& topology, const StepSettings& settings,
                             const IterationStop& stop, Progress& progress, const GivenStiffness* given = nullptr);

    /// Sets the solution with which iterations of the next step begin, #V by 3, unless Vᵏ is nearer to the solution;
    /// null: Vᵏ. It must exist until the step has been taken.
    void begin_with(const Points* guess) { guess_ = guess; }

    using ConvergedStepper::report_to;
    void report_to(FlowReport& report) const override;

  private:
    InterfaceResult solve_equation(const IterationStop& stop, const Executor& exec) override;

    const PolygonMesh* mesh_;
    WholeMeshSystem system_;
    const Points* guess_ = nullptr;
};

}  // namespace seamflow
