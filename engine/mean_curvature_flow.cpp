#include "engine/mean_curvature_flow.h"

#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/flow/flow_run.h"
#include "engine/measure/length_scale.h"
#include "engine/options/valid_options.h"
#include "engine/setup/prepared_flow.h"
#include "engine/setup/resolved_options.h"
#include "engine/state/flow_state.h"
#include "engine/tasks/failure_guard.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"

namespace seamflow {

/// A flow with everything that it works with, on its own threads.
class Flow::Session {
  public:
    Session(PolygonMesh& mesh, FlowOptions options, const FlowControl& control, bool is_observed, FlowReport& report)
        : n_expected_(options.steps)
        , workers_(options.resources.threads)
        , progress_(control)
    {
        workers_.execute([&] { set_up(mesh, std::move(options), control, is_observed, report); });
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Destroyed on the threads on which the members were made, because each thread has memory of its own.
    ~Session()
    {
        workers_.execute([&] { run_.reset(); });
    }

    /// Calls action(run) on the threads of the flow. If the action throws OptionError or InputError, it has changed
    /// nothing.
    template <class Action>
    void change(Action&& action)
    {
        guard_.run_checked([&] { workers_.execute([&] { action(*run_); }); });
    }

    /// @returns the number of steps taken until all are, or a stop is requested.
    int step(int n, const std::stop_token& stop, const StepObserver& on_step, const FlowReport& report)
    {
        int n_taken = 0;
        guard_.run([&] {
            workers_.execute([&] {
                for (; n_taken < n && !stop.stop_requested(); ++n_taken)
                    run_->take_step(on_step);
            });
        });
        if (std::ssize(report.steps) >= n_expected_)
            progress_.finish();
        return n_taken;
    }

    void complete(FlowReport& report)
    {
        workers_.execute([&] { run_->complete(report); });
    }

  private:
    /// Decides everything before the first step, and makes the run. @param given the options as the caller has given
    /// them.
    void set_up(PolygonMesh& mesh, FlowOptions given, const FlowControl& control, bool is_observed, FlowReport& report)
    {
        Stopwatch watch;
        LengthScale scale(mesh, progress_.exec());
        std::vector<Remark> remarks;
        FlowOptions options = resolved(std::move(given), mesh, scale, progress_.exec(), remarks);
        progress_.set_steps(options.steps);
        const double setup = fraction_of_setup(options, control.resume != nullptr ? control.resume->n_steps() : 0);
        progress_.enter(FlowPhase::Cut, 0, 0.0, begin_of_steppers * setup);
        constexpr double most_parts_of_prepare = 4.0;
        progress_.expect(most_parts_of_prepare);
        auto prepared = prepare(mesh, std::move(options), is_observed, control, progress_);
        report.resources.threads = workers_.threads();
        report.seconds.cut = watch.lap();
        run_.emplace(std::move(prepared), progress_, setup, report, control);
        report.remarks.insert(report.remarks.begin(), remarks.begin(), remarks.end());
    }

    /// FlowOptions::steps: progress is complete after as many steps.
    int n_expected_;
    Workers workers_;
    Progress progress_;
    std::optional<FlowRun> run_;
    FailureGuard guard_;
};

Flow::Flow(PolygonMesh& mesh, const FlowOptions& options, StepObserver on_step, FlowControl control)
    : on_step_(std::move(on_step))
    , control_(std::move(control))
{
    require_valid(options);
    if (control_.resume != nullptr)
        require_not_beyond(*control_.resume, options.steps);
    session_ = std::make_unique<Session>(mesh, options, control_, static_cast<bool>(on_step_), report_);
}

Flow::~Flow() = default;

int Flow::step(int n, const std::stop_token& stop)
{
    return session_->step(n, stop, on_step_, report_);
}

void Flow::hold(std::span<const Index> vertices)
{
    session_->change([&](FlowRun& run) { run.set_fixed(vertices, true); });
}

void Flow::release(std::span<const Index> vertices)
{
    session_->change([&](FlowRun& run) { run.set_fixed(vertices, false); });
}

void Flow::move(std::span<const Index> vertices, const Points& to)
{
    session_->change([&](FlowRun& run) { run.move_vertices(vertices, to); });
}

void Flow::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    session_->change([&](FlowRun& run) { run.attach(vertices, weights); });
}

FlowReport Flow::report() const
{
    FlowReport report = report_;
    session_->complete(report);
    return report;
}

/// Completes the report itself, without a copy.
FlowReport Flow::take_report()
{
    session_->complete(report_);
    return std::move(report_);
}

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                               const FlowControl& control)
{
    Flow flow(mesh, options, on_step, control);
    flow.step(options.steps - flow.n_steps());
    return flow.take_report();
}

}  // namespace seamflow
