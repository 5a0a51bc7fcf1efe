#include <type_traits>
#include <utility>

#include <cholmod.h>

#include "solvers/direct/foreign_solvers.h"

namespace seamflow {

/// CHOLMOD's state with 32-bit integers and with 64-bit ones, and the memory that cholmod_solve2 keeps for the next
/// call.
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
            // One ordering, the given one, is tried; no messages; the factor stays L Lᵀ by dense blocks; a
            // factorisation ends at the first pivot that is not positive.
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

CholmodWorkspace::State& CholmodWorkspace::state()
{
    if (!state_)
        state_ = {new State, [](State* state) { delete state; }};
    return *state_;
}

namespace {

/// CHOLMOD with 32-bit integers: faster, for systems whose factors have fewer than 2³¹ entries.
struct CholmodInt {
    using Integer = int;
    static constexpr auto start = cholmod_start;
    static constexpr auto finish = cholmod_finish;
    static constexpr auto analyze = cholmod_analyze;
    static constexpr auto factorize = cholmod_factorize;
    static constexpr auto solve = cholmod_solve2;
    static constexpr auto ensure_dense = cholmod_ensure_dense;
    static constexpr auto change_factor = cholmod_change_factor;
    static constexpr auto free_factor = cholmod_free_factor;
    static cholmod_common& common(CholmodWorkspace& workspace) { return workspace.state().common; }
};

/// CHOLMOD with 64-bit integers, for whole meshes.
struct CholmodLong {
    using Integer = SuiteSparse_long;
    static constexpr auto start = cholmod_l_start;
    static constexpr auto finish = cholmod_l_finish;
    static constexpr auto analyze = cholmod_l_analyze;
    static constexpr auto factorize = cholmod_l_factorize;
    static constexpr auto solve = cholmod_l_solve2;
    static constexpr auto ensure_dense = cholmod_l_ensure_dense;
    static constexpr auto change_factor = cholmod_l_change_factor;
    static constexpr auto free_factor = cholmod_l_free_factor;
    static cholmod_common& common(CholmodWorkspace& workspace) { return workspace.state().long_common; }
};

/// The number of unknowns above which a factor may outgrow 32-bit integers.
constexpr Index most_unknowns_for_cholmod_int = 1'000'000;

/// Throws a ComputationError if the last call of CHOLMOD failed.
/// @param task in the text of the error.
void require_ok(const cholmod_common& common, const char* task)
{
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
        throw_out_of_memory(task);
    if (common.status < CHOLMOD_OK)
        throw_failure("CHOLMOD", task, common.status);
}

/// The settings that CHOLMOD needs to free memory: they allocate no memory, so that this cannot fail.
template <class Interface>
struct Settings {
    cholmod_common common;

    Settings() { Interface::start(&common); }
    ~Settings() { Interface::finish(&common); }
    Settings(const Settings&) = delete;
    Settings& operator=(const Settings&) = delete;
};

/// CHOLMOD's L Lᵀ behind the interface of direct solvers (see make_cholmod_llt).
/// @tparam Interface CholmodInt or CholmodLong.
template <class Interface>
class CholmodLlt final : public DirectSolver {
  public:
    CholmodLlt(SparsePattern upper, CholmodWorkspace& workspace)
        : upper_(std::move(upper))
        , view_(upper_)
    {
        using Integer = typename Interface::Integer;
        matrix_.nrow = matrix_.ncol = usize(upper_.n());
        matrix_.nzmax = upper_.rows.size();
        matrix_.p = const_cast<Integer*>(view_.offsets());
        matrix_.i = const_cast<Integer*>(view_.rows());
        // The entries are those of the upper triangle.
        matrix_.stype = 1;
        matrix_.itype = std::is_same_v<Integer, int> ? CHOLMOD_INT : CHOLMOD_LONG;
        matrix_.xtype = CHOLMOD_PATTERN;
        matrix_.dtype = CHOLMOD_DOUBLE;
        matrix_.sorted = 1;
        matrix_.packed = 1;
        cholmod_common& common = Interface::common(workspace);
        common.method[0].ordering = CHOLMOD_NATURAL;
        common.postorder = 0;
        common.supernodal = CHOLMOD_SUPERNODAL;
        factor_.reset(Interface::analyze(&matrix_, &common));
        require_ok(common, "analysis");
    }

    [[nodiscard]] Factorisation kind() const override { return Factorisation::Cholmod; }
    [[nodiscard]] std::size_t factor_bytes() const override { return factor_->xsize * sizeof(double); }

  private:
    struct Free {
        void operator()(cholmod_factor* factor) const
        {
            Settings<Interface> settings;
            Interface::free_factor(&factor, &settings.common);
        }
    };

    bool make_factor(std::span<const double> values, FactorMemory&, SolverWorkspace& workspace) override
    {
        // CHOLMOD requires at least one unknown.
        if (upper_.n() == 0)
            return true;
        cholmod_common& common = Interface::common(workspace.cholmod);
        cholmod_sparse matrix = matrix_;
        matrix.x = const_cast<double*>(values.data());
        matrix.xtype = CHOLMOD_REAL;
        Interface::factorize(&matrix, factor_.get(), &common);
        require_ok(common, "factorisation");
        if (common.status == CHOLMOD_OK)
            return true;
        // The matrix is not positive definite.
        free_factor();
        return false;
    }

    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) override
    {
        set_rows(solution, right_hand_side.rows());
        if (upper_.n() == 0)
            return;
        cholmod_dense right{};
        right.nrow = right.d = usize(upper_.n());
        right.ncol = 3;
        right.nzmax = 3 * right.nrow;
        right.x = const_cast<double*>(right_hand_side.data());
        right.xtype = CHOLMOD_REAL;
        right.dtype = CHOLMOD_DOUBLE;
        CholmodWorkspace::State& kept = workspace.cholmod.state();
        cholmod_common& common = Interface::common(workspace.cholmod);
        // cholmod_solve2 does not look whether it gets this memory.
        const std::size_t n = right.nrow;
        const auto ensure = [&](cholmod_dense*& dense, std::size_t rows, std::size_t columns) {
            Interface::ensure_dense(&dense, rows, columns, rows, CHOLMOD_REAL, &common);
            require_ok(common, "solution");
        };
        ensure(kept.solution, n, 3);
        ensure(kept.first, n, 3);
        ensure(kept.second, 3, factor_->maxesize);
        Interface::solve(CHOLMOD_A, factor_.get(), &right, nullptr, &kept.solution, nullptr, &kept.first, &kept.second,
                         &common);
        require_ok(common, "solution");
        solution = Eigen::Map<const Columns>(static_cast<const double*>(kept.solution->x), right_hand_side.rows(), 3);
    }

    /// Frees the factor, but keeps the result of the analysis.
    void free_factor() override
    {
        if (upper_.n() == 0)
            return;
        Settings<Interface> settings;
        Interface::change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor_.get(), &settings.common);
    }

    SparsePattern upper_;
    PatternView<typename Interface::Integer> view_;
    /// The matrix without values.
    cholmod_sparse matrix_{};
    std::unique_ptr<cholmod_factor, Free> factor_;
};

}  // namespace

std::unique_ptr<DirectSolver> make_cholmod_llt(SparsePattern upper, CholmodWorkspace& workspace)
{
    if (upper.n() > most_unknowns_for_cholmod_int)
        return std::make_unique<CholmodLlt<CholmodLong>>(std::move(upper), workspace);
    return std::make_unique<CholmodLlt<CholmodInt>>(std::move(upper), workspace);
}

}  // namespace seamflow
