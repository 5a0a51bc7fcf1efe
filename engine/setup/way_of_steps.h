#pragma once

#include <optional>
#include <variant>

#include "engine/options/approach.h"
#include "engine/setup/cost_model.h"
#include "engine/setup/sweep_steps.h"
#include "solvers/krylov/stopping_criterion.h"

/// The ways of taking steps, as decided before the first step: one type for each, with the settings that it alone has.
/// Nothing in them is left open. A further way is a type here, a case of way_of in flow_plan.cpp, and a stepper that
/// make_stepper.cpp makes. Each type has
/// - `approach`: its approach; Sweep for explicit steps, which no Approach names: neither converges;
/// - `is_whole`: whether steps are taken without sub-meshes.
namespace seamflow {

/// Sub-meshes that converge to the undecomposed step.
struct ConvergedSteps {
    static constexpr Approach approach = Approach::Converged;
    static constexpr bool is_whole = false;

    /// Ends the iteration by the residual on Γ, relative to that of the positions before the step.
    IterationStop stop;
};

/// Conjugate gradients on the whole mesh.
struct GradientSteps {
    static constexpr Approach approach = Approach::ConjugateGradients;
    static constexpr bool is_whole = true;

    /// Ends the iteration by the residual of all rows, relative to that of the positions before the step.
    IterationStop stop;
    /// The input of the costs of steps, if they may begin with the solution by one factorisation (see
    /// SwitchingStepper); otherwise empty.
    std::optional<FlowSize> costs = {};
};

/// One factorisation of the whole mesh: exact. Factors in single precision are refined until a residual is reached.
struct UndecomposedSteps {
    static constexpr Approach approach = Approach::Undecomposed;
    static constexpr bool is_whole = true;

    /// The tolerance that was asked for; empty: none was.
    std::optional<double> tolerance = {};
    int most_iterations = 1000;

    /// Ends the refinement of a step.
    [[nodiscard]] IterationStop stop() const { return {tolerance.value_or(1e-10), most_iterations}; }
};

/// Explicit Euler steps of the whole mesh.
struct ExplicitSteps {
    static constexpr Approach approach = Approach::Sweep;
    static constexpr bool is_whole = true;
};

/// The way of taking steps.
using WayOfSteps = std::variant<SweepSteps, ConvergedSteps, GradientSteps, UndecomposedSteps, ExplicitSteps>;

/// The approach of a way.
Approach approach_of(const WayOfSteps& way);

/// The tolerance of the steps, if they are converged or one was asked for.
std::optional<double> tolerance_of(const WayOfSteps& way);

/// Whether steps are taken without sub-meshes.
bool takes_whole_mesh(const WayOfSteps& way);

}  // namespace seamflow
