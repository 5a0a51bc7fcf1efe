#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"
#include "solvers/krylov/stopping_criterion.h"

namespace seamflow {

/// Computes points, n by 3, from others.
using MapPoints = std::function<void(const Points& from, Points& to)>;

/// Two arrays A and B, n by 3, whose columns are multiplied pair by pair.
struct VectorPair {
    const Points& a;
    const Points& b;
};

/// Computes the inner products of pairs of vectors, A and B, column by column, all pairs at once. Additions always have
/// the same order.
using InnerProducts = std::function<std::vector<Point>(std::initializer_list<VectorPair> pairs, const Executor& exec)>;

/// The vectors of conjugate gradients, in Saad's notation, each n by 3: three right-hand sides at once, each with its
/// own coefficients.
struct ConjugateGradientVectors {
    /// @param how computes inner products.
    ConjugateGradientVectors(Index n, InnerProducts how)
        : r(n, 3)
        , p(n, 3)
        , q(n, 3)
        , z(n, 3)
        , products(std::move(how))
    {
    }

    /// Begins the iteration for the right-hand side b at x = 0, whose residual is b.
    void begin(const Points& b, const Executor& exec)
    {
        r = b;
        b_norms = norms(b, exec);
        p.setZero();
        q.setZero();
        pq.setZero();
        alpha.setOnes();
    }

    /// The norm of each column.
    [[nodiscard]] Point norms(const Points& a, const Executor& exec) const
    {
        return products({{a, a}}, exec).front().cwiseSqrt();
    }

    /// The residual B - A X, the direction, its product with A, and the preconditioned residual.
    Points r;
    Points p;
    Points q;
    Points z;
    InnerProducts products;
    /// The norms of B; (p, A p); the step size of the last step along p.
    Point b_norms = Point::Zero();
    Point pq = Point::Zero();
    Point alpha = Point::Ones();
};

/// The quotients; 0 where the denominator is not positive.
inline Point quotients(const Point& numerators, const Point& denominators)
{
    return (denominators.array() > 0.0).select(numerators.array() / denominators.array(), 0.0).matrix();
}

/// The largest of the three ratios, except those with denominator 0. Not a number if one of them is not a number.
inline double largest_ratio(const Point& norms, const Point& first)
{
    double largest = 0.0;
    for (Eigen::Index c = 0; c < 3; ++c)
        if (const double ratio = norms[c] / first[c]; first[c] != 0.0 && !(ratio <= largest))
            largest = std::isnan(largest) ? largest : ratio;
    return largest;
}

/// Moves x along p to the least energy, and updates r.
/// @param multiply multiply(p, q) makes q = A p.
inline void advance(const MapPoints& multiply, Points& x, ConjugateGradientVectors& v, const Executor& exec)
{
    // q = A p
    multiply(v.p, v.q);
    const std::vector<Point> found = v.products({{v.p, v.q}, {v.p, v.r}}, exec);
    // α = (p, r) / (p, q)
    v.pq = found[0];
    v.alpha = quotients(found[1], v.pq);
    // x = x + α p, r = r - α q
    for_each(exec, static_cast<Index>(x.rows()), [&](Index i) {
        x.row(i) += v.p.row(i).cwiseProduct(v.alpha);
        v.r.row(i) -= v.q.row(i).cwiseProduct(v.alpha);
    });
}

/// The operators of the equations A X = B.
struct PreconditionedEquations {
    /// multiply(p, q) makes q = A p.
    MapPoints multiply;
    /// precondition(r, z) makes z = M⁻¹ r.
    MapPoints precondition;
    /// measure(x, r) makes r = B - A X exactly.
    MapPoints measure;
};

/// Conjugate gradients for A X = B with a symmetric positive definite A, preconditioned (Saad, Iterative Methods for
/// Sparse Linear Systems, 2003, algorithm 9.1), for products in low precision: the residual is occasionally measured
/// exactly, without a restart; its drift up to then decides whether it must be measured again. Sums are taken in a
/// fixed order: the bits do not depend on how loops are run.
/// @param stop relative to the norms of B, for each column.
/// @param x in: the start. Out: the solution.
/// @param v in: the vectors after `begin`, and after calls of `advance` that have led to x.
inline IterationResult conjugate_gradients(const PreconditionedEquations& equations, const IterationStop& stop,
                                           Points& x, ConjugateGradientVectors& v, const Executor& exec)
{
    // The most iterations between two measurements, the most that they reduce the residual by, and the largest fraction
    // of the residual that counts as enough progress.
    constexpr int most_iterations_at_once = 100;
    constexpr double most_reduction_at_once = 1e-4;
    constexpr double most_left = 0.5;
    // The drift of the residual by rounding, relative to the residual measured before: an assumption for the first
    // measurement, and the least value. The last residual is not measured if `safety` times the drift is below the
    // tolerance.
    constexpr double first_drift = 1e-4;
    constexpr double least_drift = 1e-7;
    constexpr double safety = 10.0;

    // The norms of the residual that end the iteration.
    const Point tolerances = stop.tolerance * v.b_norms;
    Point measured = v.b_norms;
    Point drift = Point::Constant(first_drift);
    // The norms at which the residual is to be measured: below the tolerances by the drift that is allowed for.
    const auto goals = [&] {
        return Point(((1.0 - 1.0 / safety) * tolerances).cwiseMax(most_reduction_at_once * measured));
    };
    const auto is_below = [](const Point& norms, const Point& limits) {
        return (norms.array() <= limits.array()).all();
    };
    // The norms of the residual. If they are below the goals, the residual is measured, unless it is below the
    // tolerance whatever its drift.
    const auto norms_as_measured = [&] {
        const Point norms = v.norms(v.r, exec);
        const Point doubt = safety * drift.cwiseProduct(measured);
        if (!is_below(norms, goals()) || is_below(norms.cwiseMax(doubt), tolerances))
            return norms;
        equations.measure(x, v.z);
        for_each(exec, static_cast<Index>(x.rows()), [&](Index i) { v.r.row(i) -= v.z.row(i); });
        drift = quotients(v.norms(v.r, exec), measured).cwiseMax(least_drift);
        v.r.swap(v.z);
        return measured = v.norms(v.r, exec);
    };
    Point norms = norms_as_measured();
    StoppingCriterion criterion(stop, most_left, largest_ratio(norms, v.b_norms));
    while (!criterion.is_met()) {
        const int most = std::min(criterion.iterations_left(), most_iterations_at_once);
        int iterations = 0;
        do {
            // z = M⁻¹ r
            equations.precondition(v.r, v.z);
            // β = -(z, q) / (p, q) makes p conjugate to the previous direction even if the residual has just been
            // measured.
            const Point beta = -quotients(v.products({{v.z, v.q}}, exec).front(), v.pq);
            // p = z + β p
            for_each(exec, static_cast<Index>(x.rows()),
                     [&](Index i) { v.p.row(i) = v.z.row(i) + v.p.row(i).cwiseProduct(beta); });
            advance(equations.multiply, x, v, exec);
        } while (++iterations < most && !is_below(v.norms(v.r, exec), goals()));
        const Point before = std::exchange(norms, norms_as_measured());
        criterion.note(iterations, largest_ratio(norms, v.b_norms), largest_ratio(norms, before));
        // Rounding can spoil the directions so much that they make no progress: the next direction is the
        // preconditioned residual alone.
        if (criterion.is_stalling())
            v.pq.setZero();
    }
    return criterion.result(largest_ratio(norms, v.b_norms));
}

}  // namespace seamflow
