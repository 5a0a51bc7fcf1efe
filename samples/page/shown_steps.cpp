#include "samples/page/shown_steps.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// Approximate bytes of a vertex of one state in the file: its position, curvature and distance.
constexpr double bytes_of_state = 8.0;
constexpr double bytes_of_undecomposed_state = 6.0;
constexpr double most_bytes = 80e6;
constexpr int most_steps = 200;

}  // namespace

std::vector<int> shown_steps(int steps, Index n_vertices, bool undecomposed)
{
    const double per_step =
        std::max(n_vertices, 1) * (bytes_of_state + (undecomposed ? bytes_of_undecomposed_state : 0));
    const int room = static_cast<int>(std::clamp(most_bytes / per_step, 1.0, static_cast<double>(most_steps)));
    const int n = std::min(steps, room);
    std::vector<int> shown;
    for (int k = 1; k <= n; ++k)
        shown.push_back(static_cast<int>(std::lround(static_cast<double>(steps) * k / n)));
    return shown;
}

std::string remark_on_shown_steps(int steps, int shown)
{
    if (shown == steps)
        return {};
    return "The page shows " + std::to_string(shown) + " of the " + std::to_string(steps) +
           " steps' surfaces: as many of this run's as a browser can take; its plots have all steps.";
}

}  // namespace seamflow
