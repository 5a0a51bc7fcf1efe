#include "solvers/direct/make_solver.h"

#include <cassert>
#include <optional>
#include <utility>

#include "solvers/direct/foreign_solvers.h"
#include "solvers/direct/lu_solver.h"

namespace seamflow {

namespace {

/// The number of unknowns up to which our own factorisation is faster, or as fast with less memory (measured on
/// triangles and hexagons, two threads).
constexpr Index most_unknowns_for_ldl = 2'000'000;

/// The number of unknowns above which UMFPACK is faster if rows have many entries (measured: two-ring rows on
/// hexagons).
constexpr Index most_unknowns_for_lu = 20'000;

/// An LdlSolver behind the interface of direct solvers.
class OwnLdl final : public DirectSolver {
  public:
    OwnLdl(const SparsePattern& upper, const EliminationTree& tree, Executor exec, Pivots pivots)
        : solver_(upper, {}, tree, std::move(exec), pivots)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Own; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes<double>(); }

  private:
    bool make_factor(std::span<const double> values, FactorMemory& memory, SolverWorkspace& workspace) override
    {
        factor_ = solver_.factorise<double>(values, memory, workspace.ldl);
        return factor_.has_value();
    }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        factor_->solve(right_hand_side, solution, workspace.ldl);
    }
    void free_factor() override { factor_.reset(); }

    LdlSolver solver_;
    std::optional<LdlFactor<double>> factor_;
};

/// Uses an LuSolver if the pivots on the diagonal are acceptable, and otherwise UMFPACK or Eigen, which search for
/// better ones. The choice depends only on the matrix and the build.
class OwnLu final : public DirectSolver {
  public:
    explicit OwnLu(const SparsePattern& pattern)
        : pattern_(&pattern)
        , solver_(pattern)
    {
    }

    [[nodiscard]] Factorisation kind() const override { return fallback_ ? fallback_->kind() : Factorisation::Own; }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_.factor_bytes(); }

  private:
    bool make_factor(std::span<const double> values, FactorMemory& memory, SolverWorkspace& workspace) override
    {
        factor_ = solver_.factorise(values, memory, workspace.lu);
        if (factor_)
            return true;
        if (!fallback_)
            fallback_ = is_available(Factorisation::Umfpack) ? make_umfpack_lu(*pattern_) : make_eigen_lu(*pattern_);
        fallback_factor_ = fallback_->factorise(values, memory, workspace);
        return fallback_factor_.has_value();
    }
    [[nodiscard]] bool is_nearly_singular() const override
    {
        return fallback_factor_ && fallback_factor_->is_nearly_singular();
    }
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        set_rows(solution, right_hand_side.rows());
        if (factor_)
            factor_->solve(right_hand_side, solution, workspace.lu);
        else
            fallback_factor_->solve(right_hand_side, solution, workspace);
    }
    void free_factor() override
    {
        factor_.reset();
        fallback_factor_.reset();
    }

    const SparsePattern* pattern_;
    LuSolver solver_;
    std::optional<LuSolver::Factor> factor_;
    /// Null until it is needed.
    std::unique_ptr<DirectSolver> fallback_;
    std::optional<Factor> fallback_factor_;
};

}  // namespace

std::unique_ptr<DirectSolver> make_symmetric_solver(SparsePattern upper, Factorisation factorisation,
                                                    SolverWorkspace& workspace, const EliminationTree& tree,
                                                    Executor exec, Pivots pivots)
{
    if (factorisation == Factorisation::Automatic)
        factorisation = upper.n() <= most_unknowns_for_ldl || !is_available(Factorisation::Cholmod)
                            ? Factorisation::Own
                            : Factorisation::Cholmod;
    if (factorisation == Factorisation::Own || pivots == Pivots::LikeDiagonal)
        return std::make_unique<OwnLdl>(upper, tree, std::move(exec), pivots);
    assert(factorisation == Factorisation::Cholmod && "no other has symmetric matrices");
    return make_cholmod_llt(std::move(upper), workspace.cholmod);
}

std::unique_ptr<DirectSolver> make_general_solver(const SparsePattern& pattern, Factorisation factorisation)
{
    if (factorisation == Factorisation::Automatic)
        factorisation = pattern.n() <= most_unknowns_for_lu || !is_available(Factorisation::Umfpack)
                            ? Factorisation::Own
                            : Factorisation::Umfpack;
    if (factorisation == Factorisation::Own)
        return std::make_unique<OwnLu>(pattern);
    // UMFPACK also replaces CHOLMOD, which supports only symmetric matrices.
    return make_umfpack_lu(pattern);
}

}  // namespace seamflow
