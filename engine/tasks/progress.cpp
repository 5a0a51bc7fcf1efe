#include "engine/tasks/progress.h"

#include <algorithm>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The least progress that is reported, as a fraction of the whole; and the number of seconds after which any progress
/// is reported.
constexpr double noticeable = 1.0 / 500.0;
constexpr double seconds_between = 0.1;

/// Clears a flag at the end of its scope.
class Cleared {
  public:
    explicit Cleared(std::atomic_flag& flag)
        : flag_(flag)
    {
    }
    ~Cleared() { flag_.clear(std::memory_order_release); }
    Cleared(const Cleared&) = delete;
    Cleared& operator=(const Cleared&) = delete;

  private:
    std::atomic_flag& flag_;
};

}  // namespace

Progress::Progress(const FlowControl& control)
    : control_(&control)
{
}

void Progress::require_going_on() const
{
    if (is_stopped())
        throw Cancelled("the flow was stopped before its end");
}

void Progress::enter(FlowPhase phase, int step, double begin, double end)
{
    now_.phase = phase;
    now_.step = step;
    begin_ = begin;
    end_ = end;
    expect(1.0);
    report(begin, true);
    require_going_on();
}

void Progress::expect(double parts)
{
    parts_ = std::max(parts, 1.0);
    done_.store(0.0, std::memory_order_relaxed);
}

void Progress::count(double parts)
{
    if (!control_->on_progress)
        return;
    const double done = done_.fetch_add(parts, std::memory_order_relaxed) + parts;
    report(begin_ + std::min(done / parts_, 1.0) * (end_ - begin_), false);
}

void Progress::finish()
{
    report(1.0, true);
}

/// Reports to the observer. If several threads call this at once, one of them reports and the others continue their
/// work.
/// @param fraction of the whole. @param at_once whether to report however small the advance is.
void Progress::report(double fraction, bool at_once)
{
    if (!control_->on_progress || is_reporting_.test_and_set(std::memory_order_acquire))
        return;
    const Cleared cleared(is_reporting_);
    fraction = std::clamp(fraction, reported_, 1.0);
    if (!at_once && fraction - reported_ < noticeable && since_report_.seconds() < seconds_between)
        return;
    reported_ = now_.fraction = fraction;
    since_report_ = Stopwatch();
    control_->on_progress(now_);
}

Executor Progress::exec() const
{
    return [this](Index n, const RangeBody& body) {
        require_going_on();
        run_in_parallel(n, [&](Index begin, Index end) {
            require_going_on();
            body(begin, end);
        });
    };
}

Executor Progress::counted_loop()
{
    return [this](Index n, const RangeBody& body) {
        require_going_on();
        expect(n);
        run_in_parallel(n, [&](Index begin, Index end) {
            require_going_on();
            body(begin, end);
            count(end - begin);
        });
    };
}

Executor LoopCount::begin()
{
    counted_ = 0.0;
    loops_ = 0;
    return [this, exec = progress_->exec()](Index n, const RangeBody& body) {
        exec(n, body);
        ++loops_;
        // With more loops than expected, no parts are left to count.
        const double part = std::min(parts_ / expected_, parts_ - counted_);
        counted_ += part;
        progress_->count(part);
    };
}

void LoopCount::end()
{
    expected_ = std::max(loops_, 1);
    progress_->count(parts_ - counted_);
}

}  // namespace seamflow
