#pragma once

#include <optional>
#include <string>

#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"

namespace seamflow {

/// One line of at most `width` columns: the current phase, a bar where there is room for it, the percentage done, and
/// the remaining time, where it is known.
std::string progress_line(const FlowProgress& progress, std::optional<double> seconds_left, int width);

/// The remaining time of a flow, extrapolated from its steps, and not from the work before them.
class TimeLeft {
  public:
    /// @param now seconds, by any clock.
    std::optional<double> after(const FlowProgress& progress, double now);

  private:
    std::optional<double> start_;
    double fraction_at_start_ = 0.0;
};

/// A line on standard error that shows the progress of a flow, redrawn in place at most ten times per second; nothing
/// at all if standard error is not a terminal.
class ProgressBar {
  public:
    enum class Shown { OnTerminal, Never };

    explicit ProgressBar(Shown shown);
    /// Erases the line.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Whether there is anything to draw on.
    [[nodiscard]] bool is_shown() const { return is_shown_; }

    /// @param is_stopping whether running tasks are waited for.
    void draw(const FlowProgress& progress, bool is_stopping);

    /// Makes room for other text; drawn again with the next progress.
    void erase();

  private:
    bool is_shown_;
    bool is_drawn_ = false;
    std::optional<double> drawn_at_;
    Stopwatch clock_;
    TimeLeft time_left_;
};

}  // namespace seamflow
