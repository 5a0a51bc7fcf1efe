#pragma once

#include <chrono>
#include <utility>

namespace seamflow {

/// Wall-clock time since it was made or last read.
class Stopwatch {
  public:
    /// Seconds since then; starts anew.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

    /// Seconds since then; goes on.
    [[nodiscard]] double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace seamflow
