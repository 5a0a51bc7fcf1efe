#include "solvers/direct/direct_solver.h"

#include <cassert>
#include <optional>
#include <utility>

#include "solvers/direct/cholmod_solver.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/lu_solver.h"
#include "solvers/direct/umfpack_solver.h"

namespace seamflow {

namespace {

/// Above this number of unknowns CHOLMOD is faster (measured on triangle meshes).
constexpr Index most_unknowns_for_ldl = 500'000;

/// Above this number of unknowns UMFPACK is faster where rows have many entries (measured: two-ring rows on hexagons).
constexpr Index most_unknowns_for_lu = 20'000;

class OwnLdl final : public DirectSolver {
  public:
    OwnLdl(const SparsePattern& upper, const EliminationTree& tree)
        : solver_(upper, 0, tree)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Own; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes(); }
    [[nodiscard]] bool factorise(std::span<const double> values, SolverWorkspace& workspace) override
    {
        return solver_.factorise(values, *workspace.factors, workspace.ldl);
    }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        solver_.solve(right_hand_side, solution, workspace.ldl);
    }
    void free_factor(FactorMemory& memory) override { solver_.free_factor(memory); }

  private:
    LdlSolver solver_;
};

class CholmodLlt final : public DirectSolver {
  public:
    CholmodLlt(SparsePattern upper, SolverWorkspace& workspace)
        : upper_(std::move(upper))
        , solver_(upper_, workspace.cholmod)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Cholmod; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes(); }
    [[nodiscard]] bool factorise(std::span<const double> values, SolverWorkspace& workspace) override
    {
        // CHOLMOD wants an unknown at least.
        return upper_.n() == 0 || solver_.factorise(values, workspace.cholmod);
    }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        set_rows(solution, right_hand_side.rows());
        if (upper_.n() > 0)
            solution = solver_.solve(right_hand_side, workspace.cholmod);
    }
    void free_factor(FactorMemory&) override
    {
        if (upper_.n() > 0)
            solver_.free_factor();
    }

  private:
    SparsePattern upper_;
    CholmodSolver solver_;
};

class UmfpackLu final : public DirectSolver {
  public:
    explicit UmfpackLu(const SparsePattern& pattern)
        : solver_(pattern)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Umfpack; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes(); }
    [[nodiscard]] bool factorise(std::span<const double> values, SolverWorkspace&) override
    {
        values_ = values;
        solver_.factorise(values);
        return true;
    }
    [[nodiscard]] bool is_nearly_singular() const override { return solver_.is_nearly_singular(); }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace&) override
    {
        set_rows(solution, right_hand_side.rows());
        solver_.solve(values_, right_hand_side, solution);
    }
    void free_factor(FactorMemory&) override { solver_.free_factor(); }

  private:
    std::span<const double> values_;
    UmfpackSolver solver_;
};

/// By an LuSolver where the diagonal will do, by UMFPACK, which looks for better pivots, where it will not. Which of
/// the two it is depends on the matrix alone.
class OwnLu final : public DirectSolver {
  public:
    explicit OwnLu(const SparsePattern& pattern)
        : pattern_(&pattern)
        , solver_(pattern)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return fallback_ ? fallback_->kind() : Factorisation::Own; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes(); }
    [[nodiscard]] bool factorise(std::span<const double> values, SolverWorkspace& workspace) override
    {
        is_nearly_singular_ = false;
        if (solver_.factorise(values, *workspace.factors, workspace.lu))
            return true;
        if (!fallback_)
            fallback_.emplace(*pattern_);
        const bool has_factor = fallback_->factorise(values, workspace);
        is_nearly_singular_ = fallback_->is_nearly_singular();
        return has_factor;
    }
    [[nodiscard]] bool is_nearly_singular() const override { return is_nearly_singular_; }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        set_rows(solution, right_hand_side.rows());
        if (solver_.has_factor())
            solver_.solve(right_hand_side, solution, workspace.lu);
        else
            fallback_->solve(right_hand_side, solution, workspace);
    }
    void free_factor(FactorMemory& memory) override
    {
        solver_.free_factor(memory);
        if (fallback_)
            fallback_->free_factor(memory);
    }

  private:
    const SparsePattern* pattern_;
    LuSolver solver_;
    /// Nothing until it is needed.
    std::optional<UmfpackLu> fallback_;
    bool is_nearly_singular_ = false;
};

}  // namespace

std::unique_ptr<DirectSolver> make_symmetric_solver(SparsePattern upper, Factorisation factorisation,
                                                    SolverWorkspace& workspace, const EliminationTree& tree)
{
    assert(factorisation != Factorisation::Umfpack && "UMFPACK has general matrices");
    if (factorisation == Factorisation::Own ||
        (factorisation == Factorisation::Automatic && upper.n() <= most_unknowns_for_ldl))
        return std::make_unique<OwnLdl>(upper, tree);
    return std::make_unique<CholmodLlt>(std::move(upper), workspace);
}

std::unique_ptr<DirectSolver> make_general_solver(const SparsePattern& pattern, Factorisation factorisation)
{
    if (factorisation == Factorisation::Own ||
        (factorisation == Factorisation::Automatic && pattern.n() <= most_unknowns_for_lu))
        return std::make_unique<OwnLu>(pattern);
    return std::make_unique<UmfpackLu>(pattern);
}

}  // namespace seamflow
