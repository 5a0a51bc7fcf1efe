#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "solvers/direct/columns.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// LU factorisation of sparse matrices of one pattern by UMFPACK: analysed once, factorised for each set of values, a
/// factor used for any number of right-hand sides, three at a time. Different objects may be used by different threads
/// at the same time.
class UmfpackSolver {
  public:
    /// Analyses the pattern, which must outlive the solver.
    /// @throws ComputationError if UMFPACK fails (memory).
    explicit UmfpackSolver(const SparsePattern& pattern);
    ~UmfpackSolver();
    UmfpackSolver(UmfpackSolver&&) noexcept;
    UmfpackSolver& operator=(UmfpackSolver&&) noexcept;

    /// UMFPACK's estimate of what a factor takes, in bytes; an upper bound for most matrices, as long as pivots from
    /// the diagonal do (see factorise).
    [[nodiscard]] std::size_t factor_bytes() const;

    /// Pivots are taken from the diagonal; where those would lose nearly all digits, the largest of each column are,
    /// and solutions are refined.
    /// @param values one per entry of the pattern; must stay as they are until the solve.
    /// @throws ComputationError if the matrix is singular or memory runs out.
    void factorise(std::span<const double> values);

    /// Whether the smallest pivot is below 1e-13 of the largest even so: a solution has three correct digits at most.
    [[nodiscard]] bool is_nearly_singular() const;

    /// Solves for three right-hand sides.
    /// @pre there is a factor: factorise has been called since the last free_factor.
    /// @param solution n by 3.
    /// @throws ComputationError if UMFPACK fails.
    void solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution);

    /// Gives the factor's memory back.
    void free_factor();

  private:
    class Backend;
    template <class Interface>
    class BackendFor;
    std::unique_ptr<Backend> backend_;
};

}  // namespace seamflow
