#include "solvers/direct/cholmod_solver.h"

#include <algorithm>
#include <string>
#include <type_traits>

#include <cholmod.h>

#include "partition/errors.h"
#include "solvers/direct/blas_work_area.h"

namespace seamflow {

/// CHOLMOD's state with 32-bit integers and with 64-bit ones, and what cholmod_solve2 keeps for the next call.
struct CholmodWorkspace::State {
    cholmod_common common;
    cholmod_common long_common;
    cholmod_dense* solution = nullptr;
    cholmod_dense* first = nullptr;
    cholmod_dense* second = nullptr;

    State()
    {
        cholmod_start(&common);
        cholmod_l_start(&long_common);
        for (cholmod_common* of : {&common, &long_common}) {
            of->nmethods = 1;
            of->print = 0;
            of->final_asis = 1;
            of->quick_return_if_not_posdef = 1;
        }
    }
    ~State()
    {
        for (cholmod_dense** dense : {&solution, &first, &second})
            cholmod_free_dense(dense, &common);
        cholmod_finish(&common);
        cholmod_l_finish(&long_common);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

CholmodWorkspace::CholmodWorkspace() = default;

CholmodWorkspace::~CholmodWorkspace() = default;
CholmodWorkspace::CholmodWorkspace(CholmodWorkspace&&) noexcept = default;
CholmodWorkspace& CholmodWorkspace::operator=(CholmodWorkspace&&) noexcept = default;

CholmodWorkspace::State& CholmodWorkspace::state()
{
    if (!state_)
        state_ = std::make_unique<State>();
    return *state_;
}

namespace {

/// CHOLMOD with 32-bit integers: faster, for systems whose factors have less than 2³¹ entries.
struct IntInterface {
    using Integer = int;
    static constexpr auto start = cholmod_start;
    static constexpr auto finish = cholmod_finish;
    static constexpr auto analyze = cholmod_analyze;
    static constexpr auto factorize = cholmod_factorize;
    static constexpr auto solve = cholmod_solve2;
    static constexpr auto change_factor = cholmod_change_factor;
    static constexpr auto free_factor = cholmod_free_factor;
    static cholmod_common& common(CholmodWorkspace& workspace) { return workspace.state().common; }
};

/// CHOLMOD with 64-bit integers, for whole meshes.
struct LongInterface {
    using Integer = SuiteSparse_long;
    static constexpr auto start = cholmod_l_start;
    static constexpr auto finish = cholmod_l_finish;
    static constexpr auto analyze = cholmod_l_analyze;
    static constexpr auto factorize = cholmod_l_factorize;
    static constexpr auto solve = cholmod_l_solve2;
    static constexpr auto change_factor = cholmod_l_change_factor;
    static constexpr auto free_factor = cholmod_l_free_factor;
    static cholmod_common& common(CholmodWorkspace& workspace) { return workspace.state().long_common; }
};

/// Above this number of unknowns a factor may outgrow 32-bit integers.
constexpr Index most_unknowns_for_int = 1'000'000;

void require_ok(const cholmod_common& common, const char* task)
{
    if (common.status >= CHOLMOD_OK)
        return;
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
        throw ComputationError(std::string("out of memory in the ") + task + " of the system: use more sub-meshes");
    throw ComputationError(std::string("CHOLMOD's ") + task + " failed with status " + std::to_string(common.status));
}

/// A matrix of CHOLMOD's that uses a pattern's memory, or a copy of it with longer integers.
template <class Integer>
class MatrixView {
  public:
    explicit MatrixView(const SparsePattern& upper)
    {
        matrix_.nrow = matrix_.ncol = at(upper.n());
        matrix_.nzmax = upper.rows.size();
        if constexpr (std::is_same_v<Integer, Index>) {
            matrix_.p = const_cast<Index*>(upper.column_offsets.data());
            matrix_.i = const_cast<Index*>(upper.rows.data());
        } else {
            offsets_.assign(upper.column_offsets.begin(), upper.column_offsets.end());
            rows_.assign(upper.rows.begin(), upper.rows.end());
            matrix_.p = offsets_.data();
            matrix_.i = rows_.data();
        }
        matrix_.stype = 1;
        matrix_.itype = std::is_same_v<Integer, Index> ? CHOLMOD_INT : CHOLMOD_LONG;
        matrix_.xtype = CHOLMOD_PATTERN;
        matrix_.dtype = CHOLMOD_DOUBLE;
        matrix_.sorted = 1;
        matrix_.packed = 1;
    }

    [[nodiscard]] cholmod_sparse* pattern() { return &matrix_; }

    /// The matrix with these values, for as long as they live.
    [[nodiscard]] cholmod_sparse with(std::span<const double> values) const
    {
        cholmod_sparse matrix = matrix_;
        matrix.x = const_cast<double*>(values.data());
        matrix.xtype = CHOLMOD_REAL;
        return matrix;
    }

  private:
    cholmod_sparse matrix_{};
    std::vector<Integer> offsets_;
    std::vector<Integer> rows_;
};

template <class Interface>
cholmod_factor* analyse(cholmod_sparse* pattern, int ordering, int supernodal, cholmod_common& common)
{
    common.method[0].ordering = ordering;
    common.postorder = ordering == CHOLMOD_NATURAL ? 0 : 1;
    common.supernodal = supernodal;
    cholmod_factor* factor = Interface::analyze(pattern, &common);
    require_ok(common, "analysis");
    return factor;
}

bool needs_long(const SparsePattern& upper)
{
    return upper.n() > most_unknowns_for_int;
}

}  // namespace

class CholmodSolver::Factor {
  public:
    virtual ~Factor() = default;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
    virtual bool factorise(std::span<const double> values, CholmodWorkspace& workspace) = 0;
    virtual void solve(cholmod_dense& right_hand_side, CholmodWorkspace& workspace) = 0;
    virtual void free() = 0;
};

namespace {

template <class Interface>
void solve_by(cholmod_factor* factor, cholmod_dense& right_hand_side, CholmodWorkspace& workspace)
{
    CholmodWorkspace::State& kept = workspace.state();
    cholmod_common& common = Interface::common(workspace);
    const BlasWorkArea turn;
    Interface::solve(CHOLMOD_A, factor, &right_hand_side, nullptr, &kept.solution, nullptr, &kept.first, &kept.second,
                     &common);
    require_ok(common, "solution");
}

/// What CHOLMOD wants where it only frees: that takes no memory, so that it cannot fail.
template <class Interface>
struct Settings {
    cholmod_common common;

    Settings() { Interface::start(&common); }
    ~Settings() { Interface::finish(&common); }
    Settings(const Settings&) = delete;
    Settings& operator=(const Settings&) = delete;
};

/// LLᵀ by dense blocks, in CHOLMOD's own memory.
template <class Interface>
class BlockFactor final : public CholmodSolver::Factor {
  public:
    BlockFactor(const SparsePattern& upper, CholmodWorkspace& workspace)
        : matrix_(upper)
        , factor_(
              analyse<Interface>(matrix_.pattern(), CHOLMOD_NATURAL, CHOLMOD_SUPERNODAL, Interface::common(workspace)))
    {
    }
    ~BlockFactor() override
    {
        Settings<Interface> settings;
        Interface::free_factor(&factor_, &settings.common);
    }

    [[nodiscard]] std::size_t bytes() const override { return factor_->xsize * sizeof(double); }

    bool factorise(std::span<const double> values, CholmodWorkspace& workspace) override
    {
        cholmod_common& common = Interface::common(workspace);
        cholmod_sparse matrix = matrix_.with(values);
        const BlasWorkArea turn;
        Interface::factorize(&matrix, factor_, &common);
        require_ok(common, "factorisation");
        if (common.status == CHOLMOD_OK)
            return true;
        free();
        return false;
    }

    void solve(cholmod_dense& right_hand_side, CholmodWorkspace& workspace) override
    {
        solve_by<Interface>(factor_, right_hand_side, workspace);
    }

    void free() override
    {
        Settings<Interface> settings;
        Interface::change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor_, &settings.common);
    }

  private:
    MatrixView<typename Interface::Integer> matrix_;
    cholmod_factor* factor_;
};

}  // namespace

CholmodSolver::CholmodSolver(const SparsePattern& upper, CholmodWorkspace& workspace)
{
    if (needs_long(upper))
        factor_ = std::make_unique<BlockFactor<LongInterface>>(upper, workspace);
    else
        factor_ = std::make_unique<BlockFactor<IntInterface>>(upper, workspace);
}

CholmodSolver::~CholmodSolver() = default;
CholmodSolver::CholmodSolver(CholmodSolver&&) noexcept = default;
CholmodSolver& CholmodSolver::operator=(CholmodSolver&&) noexcept = default;

std::size_t CholmodSolver::factor_bytes() const
{
    return factor_->bytes();
}

bool CholmodSolver::factorise(std::span<const double> values, CholmodWorkspace& workspace)
{
    return factor_->factorise(values, workspace);
}

Eigen::Map<const Columns> CholmodSolver::solve(const Columns& right_hand_side, CholmodWorkspace& workspace) const
{
    cholmod_dense dense{};
    dense.nrow = static_cast<std::size_t>(right_hand_side.rows());
    dense.ncol = 3;
    dense.nzmax = 3 * dense.nrow;
    dense.d = dense.nrow;
    dense.x = const_cast<double*>(right_hand_side.data());
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    factor_->solve(dense, workspace);
    return {static_cast<const double*>(workspace.state().solution->x), right_hand_side.rows(), 3};
}

void CholmodSolver::free_factor()
{
    factor_->free();
}

}  // namespace seamflow
