#include "solvers/denoising/chebyshev.h"

#include <cmath>
#include <numbers>

namespace seamflow {

namespace {

/// (L - 1) x at vertex i of the sample: L x is x minus the mean over the neighbours, or 0 if the vertex does not move.
Eigen::RowVector4d shifted_laplacian(const FilterSample& sample, const Signals& x, Index i)
{
    const auto neighbours = sample.neighbours[i];
    if (neighbours.empty())
        return -x.row(i);
    Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
    for (const Index j : neighbours)
        sum += x.row(j);
    return sum / -static_cast<double>(neighbours.size());
}

}  // namespace

ChebyshevExpansion::ChebyshevExpansion(Index n_terms)
    : nodes_(4 * n_terms)
    , weights_(n_terms, 4 * n_terms)
{
    const auto n_nodes = static_cast<double>(nodes_.size());
    for (Index k = 0; k < nodes_.size(); ++k) {
        const double angle = std::numbers::pi * (k + 0.5) / n_nodes;
        nodes_[k] = 1.0 + std::cos(angle);
        for (Index j = 0; j < n_terms; ++j)
            weights_(j, k) = (j == 0 ? 1.0 : 2.0) / n_nodes * std::cos(j * angle);
    }
}

Eigen::VectorXd ChebyshevExpansion::coefficients(const std::function<double(double)>& f) const
{
    return weights_ * nodes_.unaryExpr(f);
}

void visit_chebyshev_basis(const FilterSample& sample, const Signals& signals, Index n_terms, const VisitTerm& visit,
                           const Executor& exec)
{
    Signals before(signals.rows(), Signals::ColsAtCompileTime);
    Signals term = signals;
    visit(0, term);
    for (Index j = 1; j < n_terms; ++j) {
        // With x = L - 1: T₁ = x T₀, Tⱼ = 2 x Tⱼ₋₁ - Tⱼ₋₂, stored in place of Tⱼ₋₂.
        for_each(exec, sample.neighbours.size(), [&](Index i) {
            const Eigen::RowVector4d next = shifted_laplacian(sample, term, i);
            if (j == 1)
                before.row(i) = next;
            else
                before.row(i) = 2.0 * next - before.row(i);
        });
        before.swap(term);
        visit(j, term);
    }
}

}  // namespace seamflow
