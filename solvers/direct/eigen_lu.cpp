#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/SparseLU>

#include "solvers/direct/foreign_solvers.h"
#include "solvers/direct/ldl_solver.h"

namespace seamflow {

namespace {

template <class Integer>
using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Integer>;

/// The most refinements of a solution.
constexpr int most_refinements = 2;

/// Eigen's factors, with further data.
template <class Integer>
class Factors : public Eigen::SparseLU<Matrix<Integer>, Eigen::COLAMDOrdering<Integer>> {
  public:
    /// Whether the factorisation was completed. Eigen's info() does not report that memory ran out.
    [[nodiscard]] bool is_complete() const { return this->m_factorizationIsOk; }

    /// The smallest pivot divided by the largest.
    [[nodiscard]] double condition() const
    {
        double least = 1.0;
        double most = 0.0;
        for (Eigen::Index column = 0; column < this->cols(); ++column)
            for (typename Factors::SCMatrix::InnerIterator entry(this->m_Lstore, column); entry; ++entry)
                if (entry.index() == column) {
                    const double pivot = std::abs(entry.value());
                    least = most > 0.0 ? std::min(least, pivot) : pivot;
                    most = std::max(most, pivot);
                    break;
                }
        return least / most;
    }
    [[nodiscard]] std::size_t bytes() const
    {
        return static_cast<std::size_t>(this->nnzL() + this->nnzU()) * (sizeof(double) + sizeof(Integer));
    }
};

/// Eigen's L U behind the interface of direct solvers (see make_eigen_lu).
template <class Integer>
class EigenLu final : public DirectSolver {
  public:
    explicit EigenLu(const SparsePattern& pattern)
        : matrix_(pattern.n(), pattern.n())
    {
        matrix_.resizeNonZeros(pattern.n_entries());
        std::ranges::copy(pattern.column_offsets, matrix_.outerIndexPtr());
        std::ranges::copy(pattern.rows, matrix_.innerIndexPtr());
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Eigen; }
    [[nodiscard]] std::size_t factor_bytes() const override { return factor_bytes_; }

  private:
    /// The rows are divided by their sizes, as in UMFPACK, so that pivots of different rows can be compared.
    bool make_factor(std::span<const double> values, FactorMemory&, SolverWorkspace&) override
    {
        const Eigen::Map<const Eigen::VectorXd> given(values.data(), matrix_.nonZeros());
        const Eigen::Map<const Eigen::Matrix<Integer, Eigen::Dynamic, 1>> rows(matrix_.innerIndexPtr(),
                                                                               matrix_.nonZeros());
        row_sizes_.setZero(matrix_.rows());
        for (Eigen::Index k = 0; k < rows.size(); ++k)
            row_sizes_[rows[k]] += std::abs(given[k]);
        row_sizes_ = row_sizes_.unaryExpr(&power_of_two_near);
        for (Eigen::Index k = 0; k < rows.size(); ++k)
            matrix_.valuePtr()[k] = given[k] / row_sizes_[rows[k]];
        factors_.emplace().compute(matrix_);
        if (!factors_->is_complete()) {
            // Only the text of the error distinguishes the two failures.
            if (factors_->lastErrorMessage().find("MEMORY") != std::string::npos)
                throw_out_of_memory("factorisation");
            throw_singular();
        }
        factor_bytes_ = factors_->bytes();
        is_nearly_singular_ = !(factors_->condition() >= least_condition);
        return true;
    }

    [[nodiscard]] bool is_nearly_singular() const override { return is_nearly_singular_; }

    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace&) override
    {
        set_rows(solution, right_hand_side.rows());
        for (Eigen::Index c = 0; c < 3; ++c) {
            const Eigen::VectorXd scaled = right_hand_side.col(c).cwiseQuotient(row_sizes_);
            Eigen::VectorXd x = factors_->solve(scaled);
            Eigen::VectorXd residual = scaled - matrix_ * x;
            for (int i = 0; i < most_refinements; ++i) {
                const Eigen::VectorXd refined = x + factors_->solve(residual);
                const Eigen::VectorXd remaining = scaled - matrix_ * refined;
                if (!(remaining.lpNorm<Eigen::Infinity>() < residual.lpNorm<Eigen::Infinity>()))
                    break;
                x = refined;
                residual = remaining;
            }
            solution.col(c) = x;
        }
    }

    void free_factor() override { factors_.reset(); }

    /// The matrix, its rows divided by row_sizes_.
    Matrix<Integer> matrix_;
    /// Per row: a power of two near the sum of the absolute values.
    Eigen::VectorXd row_sizes_;
    std::optional<Factors<Integer>> factors_;
    std::size_t factor_bytes_ = 0;
    bool is_nearly_singular_ = false;
};

/// The number of unknowns above which a factor may outgrow 32-bit integers.
constexpr Index most_unknowns_for_short_integers = 100'000;

}  // namespace

std::unique_ptr<DirectSolver> make_eigen_lu(const SparsePattern& pattern)
{
    if (pattern.n() <= most_unknowns_for_short_integers)
        return std::make_unique<EigenLu<Index>>(pattern);
    return std::make_unique<EigenLu<std::int64_t>>(pattern);
}

}  // namespace seamflow
