#pragma once

#include <algorithm>
#include <utility>

#include "solvers/krylov/arnoldi.h"
#include "solvers/krylov/stopping_criterion.h"
#include "solvers/krylov/sums.h"

namespace seamflow {

/// Vectors of GMRES.
struct GmresVectors {
    /// Its memory is reused.
    KrylovBasis& basis;
    /// In: where to start. Out: the solution.
    Points& x;
    /// B - A X.
    const Points& residual;
};

/// How a cycle of GMRES ended.
struct GmresCycle {
    /// Products with A.
    int iterations = 0;
    /// See HessenbergLeastSquares::amplification.
    double amplification = 1.0;
};

/// The generalised minimal residual method of Saad and Schultz (1986) for A X = B with any regular matrix A and three
/// right-hand sides, whose solutions are sought in one common subspace (block GMRES, Vital 1990). It does not break
/// down: linearly dependent directions are left out. Adds to X the correction of least residual. Sums are taken in a
/// fixed order: the bits do not depend on how loops are run.
/// @param multiply multiply(v, product) makes the product A v.
/// @param goal ends when the residual is estimated to be no larger, in the Euclidean norm over all three columns. If
///        that says too little of X, because the amplification is above most_amplification, the goal is divided by
///        their ratio.
/// @param most products with A, for each of which 24 n bytes are kept.
template <class Multiply>
GmresCycle gmres_cycle(const Multiply& multiply, double goal, int most, const GmresVectors& vectors,
                       const Executor& exec)
{
    KrylovBasis& V = vectors.basis;
    HessenbergLeastSquares least_squares(V.begin(vectors.residual, exec));
    int iterations = 0;
    for (; iterations < most && !least_squares.has_reached(goal); ++iterations) {
        V.extend(multiply);
        least_squares.append(V.orthogonalise(exec));
    }
    V.add_combination(least_squares.solution(), vectors.x, exec);
    return {iterations, least_squares.amplification()};
}

/// How GMRES ended.
struct GmresResult : IterationResult {
    /// The largest of all cycles.
    double amplification = 1.0;
};

/// Restarted GMRES: cycles that discard all previous directions, with the residual measured after each.
/// @param measure updates the residual to X.
/// @param stop residuals in the Euclidean norm over all three columns; as the goal of a cycle they count for more where
///        the amplification is large.
/// @param most_in_cycle see gmres_cycle.
/// @param vectors with the residual that `measure` updates. In: that of x.
template <class Multiply, class Measure>
GmresResult gmres(const Multiply& multiply, const Measure& measure, const IterationStop& stop, int most_in_cycle,
                  const GmresVectors& vectors, const Executor& exec)
{
    // The fraction of the residual that a cycle may leave with enough progress. GMRES's estimated residual is about the
    // true one.
    constexpr double most_left = 0.95;
    constexpr double safety = 0.8;

    double size = norm(vectors.residual, exec);
    double amplification = 1.0;
    const auto excess = [&] { return std::max(1.0, amplification / most_amplification); };
    StoppingCriterion criterion(stop, most_left, size);
    while (!criterion.is_met()) {
        const GmresCycle cycle = gmres_cycle(multiply, safety * stop.tolerance / excess(),
                                             std::min(most_in_cycle, criterion.iterations_left()), vectors, exec);
        amplification = std::max(amplification, cycle.amplification);
        measure();
        const double before = std::exchange(size, norm(vectors.residual, exec));
        criterion.note(cycle.iterations, size * excess(), size / before);
    }
    return {criterion.result(size), amplification};
}

}  // namespace seamflow
