#pragma once

#include <optional>
#include <string>

#include "engine/options/flow_control.h"
#include "engine/tasks/stopwatch.h"

namespace seamflow {

/// One line of at most `width` columns: what is being done, a bar where there is room for it, the part that is done in
/// percent, and the time that is left, where it is known.
std::string progress_line(const FlowProgress& progress, std::optional<double> seconds_left, int width);

/// How much time is left of a flow, as the steps so far have gone: what comes before them says nothing.
class TimeLeft {
  public:
    /// @param now seconds, by any clock.
    std::optional<double> after(const FlowProgress& progress, double now);

  private:
    std::optional<double> start_;
    double fraction_at_start_ = 0.0;
};

/// A line on standard error that says how far a flow is, redrawn in place at most ten times per second; nothing at all
/// where standard error is no terminal.
class ProgressBar {
  public:
    enum class Shown { OnTerminal, Never };

    explicit ProgressBar(Shown shown);
    /// Erases it.
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
