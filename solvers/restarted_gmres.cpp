#include "solvers/restarted_gmres.h"

#include <algorithm>
#include <utility>

#include "solvers/stagnation.h"

namespace seamflow {

namespace {

/// What a cycle may leave of the residual without having stalled.
constexpr double most_left = 0.95;
/// The residual that GMRES estimates is about the true one.
constexpr double safety = 0.8;

}  // namespace

RestartResult solve_restarted(const RestartedEquation& equation, const RestartStop& stop, Gmres& gmres, Points& x,
                              const Points& residual, const Loop& loop)
{
    RestartResult result{.residual = norm(residual, loop)};
    Stagnation stagnation(most_left);
    const auto excess = [&] { return std::max(1.0, result.amplification / Gmres::most_amplification); };
    while (result.iterations < stop.iterations && result.residual * excess() > stop.goal && !stagnation.is_reached()) {
        const int most = std::min(stop.iterations_in_cycle, stop.iterations - result.iterations);
        result.iterations += gmres.improve(equation.multiply, residual, safety * stop.goal / excess(), most, x, loop);
        result.amplification = std::max(result.amplification, gmres.amplification());
        equation.measure();
        const double before = std::exchange(result.residual, norm(residual, loop));
        stagnation.note(result.residual / before);
    }
    // Where iterations have run out, the last cycle may have been too short to get on.
    result.stagnated = stagnation.is_reached() && result.residual > stop.goal && result.iterations < stop.iterations;
    return result;
}

}  // namespace seamflow
