#include <string>
#include <vector>

#include <cholmod.h>

#include "partition/errors.h"
#include "samples/benchmark/methods/peer_solver.h"

namespace seamflow {

namespace {

/// METIS costs four to five times AMD's time, once, and from about this size on saves more in each factorisation.
/// Measured, AMD / METIS: triangles 10,000 0.0088 / 0.0084 s, 100,000 0.132 / 0.112 s, 1,000,000 1.54 / 1.36 s, noisy
/// sphere 200,000 0.96 / 0.53 s. Simplicial instead of supernodal: equal at 10,000, 0.27 / 0.26 s at 100,000.
constexpr Index fewest_for_metis = 50'000;

/// Cholesky of the whole mesh by CHOLMOD with 64-bit integers. BLAS may use threads.
class WholeCholmod final : public PeerSolver {
  public:
    WholeCholmod()
    {
        cholmod_l_start(&common_);
        common_.print = 0;
        common_.nmethods = 1;
        common_.supernodal = CHOLMOD_SUPERNODAL;
    }

    ~WholeCholmod() override
    {
        cholmod_l_free_dense(&solution_, &common_);
        cholmod_l_free_dense(&permuted_, &common_);
        cholmod_l_free_dense(&work_, &common_);
        cholmod_l_free_factor(&factor_, &common_);
        cholmod_l_finish(&common_);
    }

    WholeCholmod(const WholeCholmod&) = delete;
    WholeCholmod& operator=(const WholeCholmod&) = delete;

    void analyse(const WholeSystem& system) override
    {
        const SparsePattern& pattern = system.pattern();
        offsets_.assign(pattern.column_offsets.begin(), pattern.column_offsets.end());
        rows_.assign(pattern.rows.begin(), pattern.rows.end());
        common_.method[0].ordering = system.n() < fewest_for_metis ? CHOLMOD_AMD : CHOLMOD_METIS;
        cholmod_sparse matrix = view(system);
        factor_ = cholmod_l_analyze(&matrix, &common_);
        require_ok("analysis");
    }

    void prepare(const WholeSystem& system) override
    {
        cholmod_sparse matrix = view(system);
        cholmod_l_factorize(&matrix, factor_, &common_);
        require_ok("factorisation");
    }

    int solve(const WholeSystem& system, Columns& solution) override
    {
        const auto n = static_cast<std::size_t>(system.n());
        cholmod_dense right_hand_side{};
        right_hand_side.nrow = right_hand_side.d = n;
        right_hand_side.ncol = 3;
        right_hand_side.nzmax = 3 * n;
        right_hand_side.x = const_cast<double*>(system.right_hand_side().data());
        right_hand_side.xtype = CHOLMOD_REAL;
        right_hand_side.dtype = CHOLMOD_DOUBLE;
        cholmod_l_solve2(CHOLMOD_A, factor_, &right_hand_side, nullptr, &solution_, nullptr, &permuted_, &work_,
                         &common_);
        require_ok("solution");
        solution = Eigen::Map<const Columns>(static_cast<const double*>(solution_->x), system.n(), 3);
        return 0;
    }

  private:
    /// The lower triangle counts; the upper one is ignored.
    cholmod_sparse view(const WholeSystem& system)
    {
        cholmod_sparse matrix{};
        matrix.nrow = matrix.ncol = static_cast<std::size_t>(system.n());
        matrix.nzmax = rows_.size();
        matrix.p = offsets_.data();
        matrix.i = rows_.data();
        matrix.x = const_cast<double*>(system.values().data());
        matrix.stype = -1;
        matrix.itype = CHOLMOD_LONG;
        matrix.xtype = CHOLMOD_REAL;
        matrix.dtype = CHOLMOD_DOUBLE;
        matrix.sorted = matrix.packed = 1;
        return matrix;
    }

    void require_ok(const char* task) const
    {
        if (common_.status == CHOLMOD_OK)
            return;
        if (common_.status == CHOLMOD_OUT_OF_MEMORY)
            throw ComputationError(std::string("out of memory in CHOLMOD's ") + task);
        throw ComputationError(std::string("CHOLMOD's ") + task + " failed with status " +
                               std::to_string(common_.status));
    }

    cholmod_common common_{};
    std::vector<SuiteSparse_long> offsets_;
    std::vector<SuiteSparse_long> rows_;
    cholmod_factor* factor_ = nullptr;
    cholmod_dense* solution_ = nullptr;
    cholmod_dense* permuted_ = nullptr;
    cholmod_dense* work_ = nullptr;
};

}  // namespace

std::unique_ptr<PeerSolver> make_cholmod_solver()
{
    return std::make_unique<WholeCholmod>();
}

}  // namespace seamflow
