#pragma once

#include <functional>
#include <memory>
#include <stop_token>

namespace seamflow {

struct FlowState;

/// What a flow is doing.
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

/// How far a flow is.
struct FlowProgress {
    FlowPhase phase = FlowPhase::Cut;
    /// The step that is being taken, from 1, of so many; 0 before the first one.
    int step = 0;
    int steps = 0;
    /// The part of the whole call that is done: from 0, with which every flow begins, to 1, with which it ends if it
    /// succeeds; never smaller than before. All steps count alike, the work before the first one like some of them.
    double fraction = 0.0;
};

/// Hears how far a flow is, at the beginning of every phase and as often as it gets on noticeably, within a step, too:
/// some hundred times, and a few times per second. Called in any thread of the flow, but never twice at the same time,
/// nor together with a StepObserver. What it throws ends the flow.
using ProgressObserver = std::function<void(const FlowProgress&)>;

/// Observes and stops a flow; the result does not depend on it.
struct FlowControl {
    /// Stops the flow as soon as running tasks are done, which start no others.
    std::stop_token stop = {};
    ProgressObserver on_progress = {};
    /// The state to resume from instead of the beginning, made by StepState::capture in an observer of the same flow:
    /// of the same mesh and options, except for the number of steps and for options that do not change results.
    std::shared_ptr<const FlowState> resume = nullptr;
};

}  // namespace seamflow
