#include "solvers/filters/step_filter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace seamflow {

namespace {

/// Coefficients of g(w) = 1 + Σ a_j (T_j(8w - 1) - T_j(-1)), j from 1 on, which approximates 1 / (1 - k w) at w = u S.
struct Polynomial {
    std::vector<double> a;
    /// The largest error of uᵏ g(u (1 - u)).
    double error = 0.0;
};

/// The least-squares fit over u in [0, 1], with the weight uᵏ that g is multiplied by.
Polynomial fit_polynomial(int order, int degree)
{
    constexpr Eigen::Index n = 1001;
    const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(n, 0.0, 1.0);
    const Eigen::ArrayXd w = u * (1.0 - u);
    const Eigen::ArrayXd weight = u.pow(order);
    Eigen::MatrixXd functions(n, degree);
    Eigen::ArrayXd before = Eigen::ArrayXd::Ones(n);
    Eigen::ArrayXd now = 8.0 * w - 1.0;
    for (int j = 1; j <= degree; ++j) {
        functions.col(j - 1) = weight * (now - (j % 2 == 0 ? 1.0 : -1.0));
        const Eigen::ArrayXd next = 2.0 * (8.0 * w - 1.0) * now - before;
        before = now;
        now = next;
    }
    // The functions are uᵏ (g - 1), which must be near this.
    const Eigen::VectorXd target = weight * (1.0 / (1.0 - order * w) - 1.0);
    const Eigen::VectorXd a = functions.colPivHouseholderQr().solve(target);
    return {{a.begin(), a.end()}, (functions * a - target).cwiseAbs().maxCoeff()};
}

/// The polynomial of least degree that is good enough.
Polynomial harmonic_polynomial(const StepFilter& filter)
{
    constexpr int highest_degree = 40;
    for (int degree = 1;; ++degree)
        if (Polynomial g = fit_polynomial(filter.order, degree);
            g.error <= filter.tolerance || degree == highest_degree)
            return g;
}

/// x = a x + b y + c z.
void combine(double a, PointBlocks& x, double b, const PointBlocks& y, double c, const PointBlocks& z,
             const Executor& exec)
{
    if (x.size() == 1) {
        for_each(exec, static_cast<Index>(x.front().rows()), [&](Index i) {
            x.front().row(i) = a * x.front().row(i) + b * y.front().row(i) + c * z.front().row(i);
        });
        return;
    }
    for_each(exec, static_cast<Index>(x.size()), [&](Index s) { x[s] = a * x[s] + b * y[s] + c * z[s]; });
}

/// rest = g(u S) rest, by the recurrence of the Chebyshev polynomials T_j(8 u S - 1).
void apply_polynomial(const Polynomial& g, PointBlocks& rest,
                      const std::function<const PointBlocks&(const PointBlocks&)>& solve, const Executor& exec)
{
    double constant = 1.0;
    for (std::size_t j = 1; j <= g.a.size(); ++j)
        constant -= g.a[j - 1] * (j % 2 == 0 ? 1.0 : -1.0);
    PointBlocks before = rest;
    PointBlocks now = rest;
    combine(constant, rest, 0.0, now, 0.0, now, exec);
    PointBlocks product;
    for (std::size_t j = 1; j <= g.a.size(); ++j) {
        // u S t = S t - S S t, t being T_{j-1} rest.
        product = solve(now);
        const PointBlocks& twice = solve(product);
        combine(1.0, product, -1.0, twice, 0.0, twice, exec);
        if (j == 1) {
            combine(-1.0, now, 8.0, product, 0.0, product, exec);
        } else {
            combine(-1.0, before, 16.0, product, -2.0, now, exec);
            before.swap(now);
        }
        combine(1.0, rest, g.a[j - 1], now, 0.0, now, exec);
    }
}

}  // namespace

std::pair<int, int> orders_of(Filter filter)
{
    return filter == Filter::Diffusion ? std::pair{1, 3} : std::pair{2, 8};
}

double transfer(const StepFilter& filter, double lambda)
{
    if (filter.kind == Filter::Diffusion)
        return 1.0 / (1.0 + std::pow(lambda, filter.order));
    return 1.0 - std::pow(lambda / (1.0 + lambda), filter.order);
}

double lambda_of(const StepFilter& filter, double left)
{
    if (filter.kind == Filter::Diffusion)
        return std::pow((1.0 - left) / left, 1.0 / filter.order);
    const double u = std::pow(1.0 - left, 1.0 / filter.order);
    return u / (1.0 - u);
}

int n_solutions(const StepFilter& filter)
{
    if (filter.kind == Filter::LowPass || filter.order == 1)
        return filter.order;
    return filter.order + 2 * static_cast<int>(harmonic_polynomial(filter).a.size());
}

void apply_filter(const StepFilter& filter, PointBlocks& rest,
                  const std::function<const PointBlocks&(const PointBlocks& data)>& solve, const Executor& exec)
{
    for (int i = 1; i < filter.order; ++i) {
        const PointBlocks& solution = solve(rest);
        combine(1.0, rest, -1.0, solution, 0.0, solution, exec);
    }
    if (filter.kind == Filter::Diffusion)
        apply_polynomial(harmonic_polynomial(filter), rest, solve, exec);
}

}  // namespace seamflow
