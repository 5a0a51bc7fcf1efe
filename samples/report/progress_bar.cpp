#include "samples/report/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace seamflow {

namespace {

constexpr double seconds_between = 0.1;
/// Seconds of steps needed to estimate the time left.
constexpr double seconds_to_judge_by = 0.5;
constexpr const char* erase_line = "\r\033[K";

bool is_terminal()
{
    const char* const term = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width()
{
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string what_is_done(const FlowProgress& progress)
{
    switch (progress.phase) {
    case FlowPhase::Cut:
        return "cutting";
    case FlowPhase::Analyse:
        return "analysing";
    case FlowPhase::Step:
    case FlowPhase::Reference:
        break;
    }
    std::string step = fmt::format("step {} of {}", progress.step, progress.steps);
    return progress.phase == FlowPhase::Step ? step : step.append(", undecomposed");
}

/// 0:07, 12:34, 5:06:07.
std::string clock_time(double seconds)
{
    const auto all = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
    if (all < 3600)
        return fmt::format("{}:{:02}", all / 60, all % 60);
    return fmt::format("{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60);
}

}  // namespace

std::string progress_line(const FlowProgress& progress, std::optional<double> seconds_left, int width)
{
    constexpr std::size_t least_bar = 8;
    constexpr std::size_t most_bar = 60;
    const std::string begin = what_is_done(progress).append("  ");
    std::string end = fmt::format("{:3} %", static_cast<int>(100.0 * progress.fraction));
    if (seconds_left)
        end.append("  ").append(clock_time(*seconds_left)).append(" left");
    const auto room = static_cast<std::size_t>(std::max(width, 0));
    const std::size_t around_bar = begin.size() + end.size() + 4;
    std::string bar;
    if (room >= around_bar + least_bar) {
        const std::size_t length = std::min(room - around_bar, most_bar);
        const auto full = static_cast<std::size_t>(progress.fraction * static_cast<double>(length));
        bar.append("[").append(full, '#').append(length - full, '-').append("]  ");
    }
    return (begin + bar + end).substr(0, room);
}

std::optional<double> TimeLeft::after(const FlowProgress& progress, double now)
{
    if (progress.step == 0)
        return std::nullopt;
    if (!start_) {
        start_ = now;
        fraction_at_start_ = progress.fraction;
    }
    const double gained = progress.fraction - fraction_at_start_;
    if (now - *start_ < seconds_to_judge_by || gained <= 0.0)
        return std::nullopt;
    return (1.0 - progress.fraction) * (now - *start_) / gained;
}

ProgressBar::ProgressBar(Shown shown)
    : is_shown_(shown == Shown::OnTerminal && is_terminal())
{
}

ProgressBar::~ProgressBar()
{
    erase();
}

void ProgressBar::draw(const FlowProgress& progress, bool is_stopping)
{
    const double now = clock_.seconds();
    const auto seconds_left = time_left_.after(progress, now);
    if (!is_shown_ || (drawn_at_ && now - *drawn_at_ < seconds_between))
        return;
    // A line as wide as the terminal would begin a new one.
    const int width = terminal_width() - 1;
    const std::string line = is_stopping
                                 ? std::string("finishing the running tasks").substr(0, static_cast<std::size_t>(width))
                                 : progress_line(progress, seconds_left, width);
    std::fprintf(stderr, "%s%s", erase_line, line.c_str());
    std::fflush(stderr);
    drawn_at_ = now;
    is_drawn_ = true;
}

void ProgressBar::erase()
{
    if (!is_drawn_)
        return;
    std::fputs(erase_line, stderr);
    std::fflush(stderr);
    is_drawn_ = false;
    drawn_at_.reset();
}

}  // namespace seamflow
