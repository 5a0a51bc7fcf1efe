#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

namespace seamflow {

class HeatStepper;
class Progress;
struct FlowPlan;
struct FlowState;
struct PolygonMesh;
struct StepSettings;
struct Topology;

/// Processes or threads that share the steps of a flow with the one that runs it (see RankGroup).
class StepSharing {
  public:
    StepSharing() = default;
    StepSharing(const StepSharing&) = delete;
    StepSharing& operator=(const StepSharing&) = delete;
    virtual ~StepSharing() = default;

    /// Whether the processes or threads can share these steps.
    [[nodiscard]] virtual bool can_share(const FlowPlan& plan, const StepSettings& settings) const = 0;

    /// Makes a stepper that shares its steps.
    /// @param mesh, topology, plan, settings are not needed later; progress must outlive the stepper. @param curvature
    /// #V: ‖ΔV⁰‖, in 1/length; empty: as if it were 0.
    /// @pre can_share(plan, settings). @throws as make_stepper.
    virtual std::unique_ptr<HeatStepper> make_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                      const FlowPlan& plan, const StepSettings& settings,
                                                      std::vector<double> curvature, Progress& progress) = 0;
};

/// The present activity of a flow.
enum class FlowPhase {
    /// Checks the mesh, joins its faces, cuts it.
    Cut,
    /// Makes the sub-meshes and analyses their equations.
    Analyse,
    /// Takes a step.
    Step,
    /// Takes a step of the undecomposed flow that ReportOptions::reference asks for.
    Reference,
};

/// The progress of a flow.
struct FlowProgress {
    FlowPhase phase = FlowPhase::Cut;
    /// The current step, from 1 (0 before the first), and the number of steps.
    int step = 0;
    int steps = 0;
    /// The fraction of the whole call that is done: from 0 at the beginning to 1 at the end of a flow that succeeds;
    /// never decreases. All steps count alike, the work before the first one like some of them.
    double fraction = 0.0;
};

/// Receives the progress of a flow, at the beginning of every phase and at every noticeable advance, also within a
/// step: up to 500 times, and up to ten more times per second. Called in any thread of the flow, but never
/// concurrently, nor together with a StepObserver. An exception from it ends the flow.
using ProgressObserver = std::function<void(const FlowProgress&)>;

/// Observes and stops a flow; the result does not depend on it.
struct FlowControl {
    /// Stops the flow as soon as running tasks are done; no others start.
    std::stop_token stop = {};
    ProgressObserver on_progress = {};
    /// The state to resume from instead of the beginning, made by StepState::capture in an observer of the same flow:
    /// of the same mesh and options, except for the number of steps and for options that do not change results.
    std::shared_ptr<const FlowState> resume = nullptr;
    /// Ranks that share the steps; must outlive the flow. An approach that is left open is then one that ranks can
    /// share: sweeps, or converged steps. Rank 0, which runs the flow, does all other work alone, including steps that
    /// ranks cannot share. Results depend on ranks only by the approach. Between the steps of a shared flow only
    /// positions can be changed (see Flow).
    StepSharing* ranks = nullptr;
};

}  // namespace seamflow
