#pragma once

#include <functional>

#include <Eigen/Core>

#include "partition/executor.h"
#include "solvers/denoising/filter_sample.h"

namespace seamflow {

/// One row per vertex of a sample, one column per signal.
using Signals = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The coefficients cⱼ with f(λ) = Σ cⱼ Tⱼ(λ - 1) on [0, 2], by interpolation at the zeros of the Chebyshev polynomial
/// whose degree is four times the number of terms (Trefethen, Approximation Theory and Approximation Practice, 2013,
/// chapter 4).
class ChebyshevExpansion {
  public:
    explicit ChebyshevExpansion(Index n_terms);

    /// @returns one coefficient per term.
    [[nodiscard]] Eigen::VectorXd coefficients(const std::function<double(double)>& f) const;

  private:
    /// The points at which f is evaluated, in [0, 2].
    Eigen::VectorXd nodes_;
    /// Number of terms by number of nodes: the coefficients are this matrix times the values of f at the nodes.
    Eigen::MatrixXd weights_;
};

/// Receives the terms of a Chebyshev basis, j = 0 … n_terms - 1, in order.
using VisitTerm = std::function<void(Index j, const Signals& term)>;

/// Makes the signals Tⱼ(L - 1) X: any filter f(L) X is a linear combination of them. L = D⁻¹ K is the Laplacian of the
/// graph, D being its degrees and K having weights of 1; its spectrum is in [0, 2]. Rows of L at vertices that do not
/// move are 0.
void visit_chebyshev_basis(const FilterSample& sample, const Signals& signals, Index n_terms, const VisitTerm& visit,
                           const Executor& exec = run_serially);

}  // namespace seamflow
