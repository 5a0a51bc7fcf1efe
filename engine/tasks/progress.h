#pragma once

#include <atomic>

#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"
#include "partition/executor.h"

namespace seamflow {

/// Reports the progress of a flow to an observer, and tells the flow whether to stop. A phase begins in one thread; its
/// parts are counted from any thread. A count costs an addition; an observer is called a few hundred times, and ten
/// more times per second.
class Progress {
  public:
    /// @param control must outlive this.
    explicit Progress(const FlowControl& control);

    [[nodiscard]] bool is_stopped() const { return control_->stop.stop_requested(); }

    /// Lets the flow stop here, if a stop was requested.
    /// @throws Cancelled in that case.
    void require_going_on() const;

    /// Sets `steps` of FlowProgress.
    void set_steps(int steps) { now_.steps = steps; }

    /// Begins a phase.
    /// @param step the number of the step; 0: before the first.
    /// @param begin, end the fraction of the whole at the beginning and at the end of the phase.
    /// @throws Cancelled if the flow is to stop.
    void enter(FlowPhase phase, int step, double begin, double end);

    /// Sets the number of parts of the present phase (less than 1 counts as 1), none of which is done.
    void expect(double parts);

    /// Counts parts as done.
    void count(double parts = 1.0);

    /// Reports that everything is done.
    void finish();

    /// An executor that runs loops on the threads of the calling arena (see run_in_parallel), and throws Cancelled
    /// before a loop, or before a range of its indices, if a stop was requested.
    [[nodiscard]] Executor exec() const;

    /// An executor like exec(); in addition, each index of a loop counts as one part that is done (see expect).
    [[nodiscard]] Executor counted_loop();

  private:
    void report(double fraction, bool at_once);

    const FlowControl* control_;
    FlowProgress now_;
    /// The fractions of the whole at the beginning and at the end of the present phase.
    double begin_ = 0.0;
    double end_ = 0.0;
    /// The number of parts of the present phase, and of those that are done.
    double parts_ = 1.0;
    std::atomic<double> done_{0.0};
    /// Set while the observer is called.
    std::atomic_flag is_reporting_;
    /// The fraction of the whole that was reported last, and the time since then.
    double reported_ = 0.0;
    Stopwatch since_report_;
};

/// Counts a task that takes an unknown number of loops: it is expected to take as many as in the last step.
class LoopCount {
  public:
    /// @param parts the number of parts that the task counts for (see Progress::expect).
    /// @param progress must outlive this.
    LoopCount(double parts, Progress& progress)
        : progress_(&progress)
        , parts_(parts)
    {
    }

    [[nodiscard]] double parts() const { return parts_; }

    /// Begins the task. @returns an executor whose loops count and may stop. This object must outlive it; one task at a
    /// time.
    [[nodiscard]] Executor begin();

    /// Ends the task, and counts the parts that are left.
    void end();

  private:
    Progress* progress_;
    double parts_;
    /// The parts that the present task has counted, and its loops so far.
    double counted_ = 0.0;
    int loops_ = 0;
    /// The number of loops in the last task; before the first task a guess.
    int expected_ = 200;
};

}  // namespace seamflow
