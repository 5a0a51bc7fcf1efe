#include "solvers/direct/umfpack_solver.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <umfpack.h>

#include "partition/errors.h"
#include "solvers/direct/blas_work_area.h"

namespace seamflow {

namespace {

/// UMFPACK with 32-bit integers: faster, for systems whose factors have less than 2³¹ bytes.
struct IntInterface {
    using Integer = int;
    static constexpr auto defaults = umfpack_di_defaults;
    static constexpr auto symbolic = umfpack_di_symbolic;
    static constexpr auto numeric = umfpack_di_numeric;
    static constexpr auto solve = umfpack_di_wsolve;
    static constexpr auto free_symbolic = umfpack_di_free_symbolic;
    static constexpr auto free_numeric = umfpack_di_free_numeric;
};

/// UMFPACK with 64-bit integers, for whole meshes.
struct LongInterface {
    using Integer = SuiteSparse_long;
    static constexpr auto defaults = umfpack_dl_defaults;
    static constexpr auto symbolic = umfpack_dl_symbolic;
    static constexpr auto numeric = umfpack_dl_numeric;
    static constexpr auto solve = umfpack_dl_wsolve;
    static constexpr auto free_symbolic = umfpack_dl_free_symbolic;
    static constexpr auto free_numeric = umfpack_dl_free_numeric;
};

/// Above this number of unknowns a factor may outgrow 32-bit integers.
constexpr Index most_unknowns_for_int = 100'000;

/// Below this ratio of the smallest pivot to the largest a solution keeps three digits or less.
constexpr double least_condition = 1e-13;

void require_ok(long status, const char* task)
{
    if (status == UMFPACK_OK)
        return;
    if (status == UMFPACK_WARNING_singular_matrix)
        throw ComputationError("the system is singular: use a smaller time step, or another Laplacian");
    if (status == UMFPACK_ERROR_out_of_memory)
        throw ComputationError(std::string("out of memory in the ") + task + " of the system: use more sub-meshes");
    throw ComputationError(std::string("UMFPACK's ") + task + " failed with status " + std::to_string(status));
}

}  // namespace

class UmfpackSolver::Backend {
  public:
    virtual ~Backend() = default;
    [[nodiscard]] virtual std::size_t factor_bytes() const = 0;
    virtual void factorise(std::span<const double> values) = 0;
    [[nodiscard]] virtual bool is_nearly_singular() const = 0;
    virtual void solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution) = 0;
    virtual void free_factor() = 0;
};

template <class Interface>
class UmfpackSolver::BackendFor final : public Backend {
  public:
    using Integer = typename Interface::Integer;

    explicit BackendFor(const SparsePattern& pattern)
        : n_(pattern.n())
        , offsets_(pattern.column_offsets.begin(), pattern.column_offsets.end())
        , rows_(pattern.rows.begin(), pattern.rows.end())
        , integer_work_(pattern.n())
        , work_(pattern.n())
    {
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

    ~BackendFor() override
    {
        free_factor();
        for (Way* way : {&fast_, &careful_})
            if (way->symbolic != nullptr)
                Interface::free_symbolic(&way->symbolic);
    }

    BackendFor(const BackendFor&) = delete;
    BackendFor& operator=(const BackendFor&) = delete;

    [[nodiscard]] std::size_t factor_bytes() const override { return factor_bytes_; }

    void factorise(std::span<const double> values) override
    {
        way_ = &fast_;
        if (pivots_do(values))
            return;
        way_ = &careful_;
        // Iterative refinement needs more room.
        work_.resize(5 * integer_work_.size());
        if (careful_.symbolic == nullptr)
            analyse(careful_);
        is_nearly_singular_ = !pivots_do(values);
        require_ok(status_, "factorisation");
    }

    [[nodiscard]] bool is_nearly_singular() const override { return is_nearly_singular_; }

    void solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution) override
    {
        for (Eigen::Index c = 0; c < 3; ++c)
            require_ok(Interface::solve(UMFPACK_A, offsets_.data(), rows_.data(), values.data(), solution.col(c).data(),
                                        right_hand_side.col(c).data(), numeric_, way_->control.data(), info_.data(),
                                        integer_work_.data(), work_.data()),
                       "solution");
    }

    void free_factor() override
    {
        if (numeric_ != nullptr)
            Interface::free_numeric(&numeric_);
        numeric_ = nullptr;
    }

  private:
    /// How to look for pivots: on the diagonal where that will do, or the largest of every column.
    struct Way {
        std::array<double, UMFPACK_CONTROL> control{};
        void* symbolic = nullptr;
    };

    void analyse(Way& way)
    {
        require_ok(Interface::symbolic(n_, n_, offsets_.data(), rows_.data(), nullptr, &way.symbolic,
                                       way.control.data(), info_.data()),
                   "analysis");
    }

    /// @returns whether there is a factor that can be trusted.
    bool pivots_do(std::span<const double> values)
    {
        free_factor();
        is_nearly_singular_ = false;
        const BlasWorkArea turn;
        status_ = Interface::numeric(offsets_.data(), rows_.data(), values.data(), way_->symbolic, &numeric_,
                                     way_->control.data(), info_.data());
        if (status_ != UMFPACK_WARNING_singular_matrix)
            require_ok(status_, "factorisation");
        return status_ == UMFPACK_OK && info_[UMFPACK_RCOND] >= least_condition;
    }

    Integer n_;
    std::vector<Integer> offsets_;
    std::vector<Integer> rows_;
    std::vector<Integer> integer_work_;
    std::vector<double> work_;
    Way fast_;
    Way careful_;
    Way* way_ = &fast_;
    std::array<double, UMFPACK_INFO> info_{};
    std::size_t factor_bytes_ = 0;
    long status_ = UMFPACK_OK;
    bool is_nearly_singular_ = false;
    void* numeric_ = nullptr;
};

UmfpackSolver::UmfpackSolver(const SparsePattern& pattern)
{
    if (pattern.n() <= most_unknowns_for_int)
        backend_ = std::make_unique<BackendFor<IntInterface>>(pattern);
    else
        backend_ = std::make_unique<BackendFor<LongInterface>>(pattern);
}

UmfpackSolver::~UmfpackSolver() = default;
UmfpackSolver::UmfpackSolver(UmfpackSolver&&) noexcept = default;
UmfpackSolver& UmfpackSolver::operator=(UmfpackSolver&&) noexcept = default;

std::size_t UmfpackSolver::factor_bytes() const
{
    return backend_->factor_bytes();
}

void UmfpackSolver::factorise(std::span<const double> values)
{
    backend_->factorise(values);
}

bool UmfpackSolver::is_nearly_singular() const
{
    return backend_->is_nearly_singular();
}

void UmfpackSolver::solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution)
{
    backend_->solve(values, right_hand_side, solution);
}

void UmfpackSolver::free_factor()
{
    backend_->free_factor();
}

}  // namespace seamflow
