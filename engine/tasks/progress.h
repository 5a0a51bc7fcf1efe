#pragma once

#include <atomic>

#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"
#include "partition/executor.h"

namespace seamflow {

/// Reports to an observer how far a flow is, and to the flow whether to stop. Phases begin in one thread; their parts
/// are counted from any thread. Costs an addition per count, and with an observer a few hundred calls of it, and ten
/// more per second.
class Progress {
  public:
    /// @param control must outlive this.
    explicit Progress(const FlowControl& control);

    [[nodiscard]] bool is_stopped() const { return control_->stop.stop_requested(); }

    /// Lets the flow stop here.
    /// @throws Cancelled if it is to stop.
    void require_going_on() const;

    /// Sets `steps` of FlowProgress.
    void set_steps(int steps) { now_.steps = steps; }

    /// Begins a phase.
    /// @param step its number; 0: before the first.
    /// @param begin, end the fraction of the whole now, and when everything is counted.
    /// @throws Cancelled if the flow is to stop.
    void enter(FlowPhase phase, int step, double begin, double end);

    /// Sets the number of parts of the present phase.
    void expect(double parts);

    /// Counts parts as done.
    void count(double parts = 1.0);

    /// All is done.
    void finish();

    /// Loops that may stop at each of their ranges, on the threads of the arena.
    [[nodiscard]] Executor exec() const;

    /// The same, and each index of a loop counts as one part that is done (see expect).
    [[nodiscard]] Executor counted_loop();

  private:
    void report(double fraction, bool at_once);

    const FlowControl* control_;
    FlowProgress now_;
    double begin_ = 0.0;
    double end_ = 0.0;
    double parts_ = 1.0;
    std::atomic<double> done_{0.0};
    /// Set while the observer is called.
    std::atomic_flag is_reporting_;
    double reported_ = 0.0;
    Stopwatch since_report_;
};

/// Counts a task that takes an unknown number of loops: it is expected to take as many as last time.
class LoopCount {
  public:
    /// @param parts that the task counts for (see Progress::expect).
    /// @param progress must outlive this.
    LoopCount(double parts, Progress& progress)
        : progress_(&progress)
        , parts_(parts)
    {
    }

    [[nodiscard]] double parts() const { return parts_; }

    /// Loops that count and may stop. This must outlive them; one at a time.
    [[nodiscard]] Executor begin();

    /// Counts what is left.
    void end();

  private:
    Progress* progress_;
    double parts_;
    double counted_ = 0.0;
    int loops_ = 0;
    int expected_ = 200;
};

}  // namespace seamflow
