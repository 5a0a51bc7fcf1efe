#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// An unsymmetric matrix that is refilled in each step, first with dt Δ, and factorised by LU. Its pattern is analysed
/// once.
class LuMatrix {
  public:
    /// @param slots per entry of the Laplacian: an entry of the pattern, one of the further values behind them, or the
    ///        last value of all, which is unused.
    /// @throws ComputationError if the analysis fails.
    LuMatrix(std::unique_ptr<LaplacianAssembler> laplacian, SparsePattern pattern, std::vector<Index> slots,
             std::size_t n_further, Factorisation factorisation);
    LuMatrix(const LuMatrix&) = delete;
    LuMatrix& operator=(const LuMatrix&) = delete;

    [[nodiscard]] Index n() const { return pattern_.n(); }

    /// See DirectSolver; null without unknowns.
    [[nodiscard]] const DirectSolver* solver() const { return solver_.get(); }

    /// Sets the values to dt Δ.
    /// @returns the entries and the further values.
    std::span<double> fill(const Points& positions, double time_step);

    /// Multiplies the rows of dt Δ, and the further values, by the step_scales of their unknowns.
    /// @param step_scales one per unknown. @param further the unknowns of the further values.
    void scale_rows(std::span<const double> step_scales, std::span<const Index> further = {});

    [[nodiscard]] double& at_slot(Index slot) { return values_[slot]; }
    [[nodiscard]] double& diagonal(Index unknown) { return values_[diagonal_slots_[unknown]]; }
    [[nodiscard]] const double* further() const { return values_.data() + pattern_.rows.size(); }

    /// @param values the result of fill, with later additions.
    /// @returns nothing where there are no unknowns.
    /// @throws ComputationError if a value is not finite, or the matrix is singular.
    [[nodiscard]] std::optional<DirectSolver::Factor> factorise(std::span<const double> values, FactorMemory& memory,
                                                                SolverWorkspace& workspace);

    /// How many factorisations so far were nearly singular: three correct digits at most.
    [[nodiscard]] Index n_nearly_singular() const { return n_nearly_singular_; }

  private:
    std::unique_ptr<LaplacianAssembler> laplacian_;
    SparsePattern pattern_;
    std::vector<Index> slots_;
    std::vector<Index> diagonal_slots_;
    /// One per entry of the pattern, the further ones, and an unused one.
    std::vector<double> values_;
    std::unique_ptr<DirectSolver> solver_;
    Index n_nearly_singular_ = 0;
};

}  // namespace seamflow
