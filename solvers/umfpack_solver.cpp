#include "solvers/umfpack_solver.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <umfpack.h>

#include "partition/errors.h"
#include "solvers/blas_turn.h"

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
        , integer_work_(at(pattern.n()))
        , work_(at(pattern.n()))
    {
        Interface::defaults(control_.data());
        control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
        control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
        control_[UMFPACK_IRSTEP] = 0;
        require_ok(Interface::symbolic(n_, n_, offsets_.data(), rows_.data(), nullptr, &symbolic_, control_.data(),
                                       info_.data()),
                   "analysis");
        factor_bytes_ = static_cast<std::size_t>(info_[UMFPACK_NUMERIC_SIZE_ESTIMATE] * info_[UMFPACK_SIZE_OF_UNIT]);
    }

    ~BackendFor() override
    {
        free_factor();
        Interface::free_symbolic(&symbolic_);
    }

    BackendFor(const BackendFor&) = delete;
    BackendFor& operator=(const BackendFor&) = delete;

    [[nodiscard]] std::size_t factor_bytes() const override { return factor_bytes_; }

    void factorise(std::span<const double> values) override
    {
        free_factor();
        const BlasTurn turn;
        require_ok(Interface::numeric(offsets_.data(), rows_.data(), values.data(), symbolic_, &numeric_,
                                      control_.data(), info_.data()),
                   "factorisation");
    }

    void solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution) override
    {
        for (Eigen::Index c = 0; c < 3; ++c)
            require_ok(Interface::solve(UMFPACK_A, offsets_.data(), rows_.data(), values.data(), solution.col(c).data(),
                                        right_hand_side.col(c).data(), numeric_, control_.data(), info_.data(),
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
    Integer n_;
    std::vector<Integer> offsets_;
    std::vector<Integer> rows_;
    std::vector<Integer> integer_work_;
    std::vector<double> work_;
    std::array<double, UMFPACK_CONTROL> control_{};
    std::array<double, UMFPACK_INFO> info_{};
    std::size_t factor_bytes_ = 0;
    void* symbolic_ = nullptr;
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

void UmfpackSolver::solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution)
{
    backend_->solve(values, right_hand_side, solution);
}

void UmfpackSolver::free_factor()
{
    backend_->free_factor();
}

}  // namespace seamflow
