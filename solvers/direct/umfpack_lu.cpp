#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <umfpack.h>

#include "solvers/direct/foreign_solvers.h"

namespace seamflow {

namespace {

/// UMFPACK with 32-bit integers: faster, for systems whose factors have less than 2³¹ bytes.
struct UmfpackInt {
    using Integer = int;
    static constexpr auto defaults = umfpack_di_defaults;
    static constexpr auto symbolic = umfpack_di_symbolic;
    static constexpr auto numeric = umfpack_di_numeric;
    static constexpr auto solve = umfpack_di_wsolve;
    static constexpr auto free_symbolic = umfpack_di_free_symbolic;
    static constexpr auto free_numeric = umfpack_di_free_numeric;
};

/// UMFPACK with 64-bit integers, for whole meshes.
struct UmfpackLong {
    using Integer = SuiteSparse_long;
    static constexpr auto defaults = umfpack_dl_defaults;
    static constexpr auto symbolic = umfpack_dl_symbolic;
    static constexpr auto numeric = umfpack_dl_numeric;
    static constexpr auto solve = umfpack_dl_wsolve;
    static constexpr auto free_symbolic = umfpack_dl_free_symbolic;
    static constexpr auto free_numeric = umfpack_dl_free_numeric;
};

/// Above this number of unknowns a factor may outgrow 32-bit integers.
constexpr Index most_unknowns_for_umfpack_int = 100'000;

/// Throws a ComputationError if a call of UMFPACK failed or found a singular matrix.
/// @param task in the text of the error.
void require_ok(long status, const char* task)
{
    if (status == UMFPACK_OK)
        return;
    if (status == UMFPACK_WARNING_singular_matrix)
        throw_singular();
    if (status == UMFPACK_ERROR_out_of_memory)
        throw_out_of_memory(task);
    throw_failure("UMFPACK", task, status);
}

/// UMFPACK's L U behind the interface of direct solvers (see make_umfpack_lu).
/// @tparam Interface UmfpackInt or UmfpackLong.
template <class Interface>
class UmfpackLu final : public DirectSolver {
  public:
    using Integer = typename Interface::Integer;

    explicit UmfpackLu(const SparsePattern& pattern)
        : n_(pattern.n())
        , view_(pattern)
    {
        work_.integers.resize(usize(pattern.n()));
        work_.numbers.resize(usize(pattern.n()));
        Interface::defaults(fast_.control.data());
        careful_.control = fast_.control;
        fast_.control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
        fast_.control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
        fast_.control[UMFPACK_IRSTEP] = 0;
        careful_.control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_UNSYMMETRIC;
        careful_.control[UMFPACK_PIVOT_TOLERANCE] = 1.0;
        careful_.control[UMFPACK_IRSTEP] = 2;
        analyse(fast_);
        factor_bytes_ = static_cast<std::size_t>(info_[UMFPACK_NUMERIC_SIZE_ESTIMATE] * info_[UMFPACK_SIZE_OF_UNIT]);
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Umfpack; }
    [[nodiscard]] std::size_t factor_bytes() const override { return factor_bytes_; }

  private:
    struct FreeSymbolic {
        void operator()(void* symbolic) const { Interface::free_symbolic(&symbolic); }
    };
    struct FreeNumeric {
        void operator()(void* numeric) const { Interface::free_numeric(&numeric); }
    };
    /// A way of choosing pivots: on the diagonal if that is acceptable, or the largest of every column.
    struct Way {
        std::array<double, UMFPACK_CONTROL> control{};
        std::unique_ptr<void, FreeSymbolic> symbolic;
    };
    /// The current factor.
    struct Numeric {
        std::unique_ptr<void, FreeNumeric> numbers;
        std::span<const double> values;
        Way* way = nullptr;
        bool is_nearly_singular = false;
    };
    /// Memory that UMFPACK needs to solve.
    struct Work {
        std::vector<Integer> integers;
        std::vector<double> numbers;
    };

    bool make_factor(std::span<const double> values, FactorMemory&, SolverWorkspace&) override
    {
        if (factorise_with(values, fast_) == UMFPACK_OK && !numeric_.is_nearly_singular)
            return true;
        // Iterative refinement needs more memory.
        work_.numbers.resize(5 * work_.integers.size());
        if (!careful_.symbolic)
            analyse(careful_);
        require_ok(factorise_with(values, careful_), "factorisation");
        return true;
    }

    [[nodiscard]] bool is_nearly_singular() const override { return numeric_.is_nearly_singular; }

    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace&) override
    {
        set_rows(solution, right_hand_side.rows());
        for (Eigen::Index c = 0; c < 3; ++c)
            require_ok(Interface::solve(UMFPACK_A, view_.offsets(), view_.rows(), numeric_.values.data(),
                                        solution.col(c).data(), right_hand_side.col(c).data(), numeric_.numbers.get(),
                                        numeric_.way->control.data(), info_.data(), work_.integers.data(),
                                        work_.numbers.data()),
                       "solution");
    }

    void free_factor() override { numeric_ = {}; }

    /// Analyses the pattern for a way of choosing pivots.
    void analyse(Way& way)
    {
        void* symbolic = nullptr;
        require_ok(Interface::symbolic(n_, n_, view_.offsets(), view_.rows(), nullptr, &symbolic, way.control.data(),
                                       info_.data()),
                   "analysis");
        way.symbolic.reset(symbolic);
    }

    /// Factorises with a way of choosing pivots.
    /// @returns UMFPACK_OK, or the warning that the matrix is singular.
    int factorise_with(std::span<const double> values, Way& way)
    {
        numeric_ = {nullptr, values, &way};
        void* numbers = nullptr;
        const int status =
            static_cast<int>(Interface::numeric(view_.offsets(), view_.rows(), values.data(), way.symbolic.get(),
                                                &numbers, way.control.data(), info_.data()));
        numeric_.numbers.reset(numbers);
        if (status != UMFPACK_WARNING_singular_matrix)
            require_ok(status, "factorisation");
        numeric_.is_nearly_singular = !(info_[UMFPACK_RCOND] >= least_condition);
        return status;
    }

    Integer n_;
    PatternView<Integer> view_;
    Way fast_;
    Way careful_;
    Numeric numeric_;
    Work work_;
    std::array<double, UMFPACK_INFO> info_{};
    std::size_t factor_bytes_ = 0;
};

}  // namespace

std::string_view gpl_parts()
{
    return "CHOLMOD and UMFPACK";
}

std::unique_ptr<DirectSolver> make_umfpack_lu(const SparsePattern& pattern)
{
    if (pattern.n() <= most_unknowns_for_umfpack_int)
        return std::make_unique<UmfpackLu<UmfpackInt>>(pattern);
    return std::make_unique<UmfpackLu<UmfpackLong>>(pattern);
}

}  // namespace seamflow
