#pragma once

#include <functional>

#include "solvers/gmres.h"

namespace seamflow {

/// A X = B, three right-hand sides, by what GMRES asks of it.
struct RestartedEquation {
    Gmres::Multiply multiply;
    /// Brings the residual B - A X up to date with X.
    std::function<void()> measure;
};

/// When the iteration ends.
struct RestartStop {
    /// Of the residual, in the Euclidean norm over all three columns. Divided by what the amplification is too much
    /// (see Gmres::improve).
    double goal = 0.0;
    /// Most products with A, of all cycles and of one of them.
    int iterations = 0;
    int iterations_in_cycle = 0;
};

/// How it ended.
struct RestartResult {
    int iterations = 0;
    /// As measured.
    double residual = 0.0;
    /// The largest of all cycles (see Gmres::amplification).
    double amplification = 1.0;
    /// Whether it ended above the goal because cycles no longer made the residual smaller (see Stagnation).
    bool stagnated = false;
};

/// GMRES that forgets its directions now and then, measures the residual and begins anew.
/// @param x in: where to start. Out: the solution.
/// @param residual that `equation` measures. In: of x.
RestartResult solve_restarted(const RestartedEquation& equation, const RestartStop& stop, Gmres& gmres, Points& x,
                              const Points& residual, const Loop& loop);

}  // namespace seamflow
