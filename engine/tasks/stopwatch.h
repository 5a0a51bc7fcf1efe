#pragma once

#include <chrono>
#include <utility>

namespace seamflow {

/// Wall-clock time since the stopwatch was made or since the last lap().
class Stopwatch {
  public:
    /// The seconds of this lap; begins a new lap.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

    /// The seconds of this lap, which goes on.
    [[nodiscard]] double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace seamflow
