#include <string>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "partition/errors.h"
#include "samples/benchmark/methods/peer_solver.h"

namespace seamflow {

namespace {

/// Eigen uses all threads to multiply matrices that are stored by rows, with both triangles.
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
constexpr int both_triangles = Eigen::Lower | Eigen::Upper;

constexpr Eigen::Index most_iterations = 20'000;

template <class Solver>
class Krylov final : public PeerSolver {
  public:
    Krylov(SystemForm form, double tolerance, int threads)
        : form_(form)
    {
        Eigen::setNbThreads(threads);
        solver_.setTolerance(tolerance);
        solver_.setMaxIterations(most_iterations);
    }

    [[nodiscard]] SystemForm form() const override { return form_; }
    [[nodiscard]] StorageOrder order() const override { return StorageOrder::ByRows; }

    void analyse(const WholeSystem& system) override { solver_.analyzePattern(view(system)); }

    void prepare(const WholeSystem& system) override
    {
        solver_.factorize(view(system));
        if (solver_.info() != Eigen::Success)
            throw ComputationError("the preconditioner cannot be made");
    }

    int solve(const WholeSystem& system, Columns& solution) override
    {
        Eigen::Index iterations = 0;
        for (Eigen::Index c = 0; c < 3; ++c) {
            solution.col(c) = solver_.solveWithGuess(system.right_hand_side().col(c), solution.col(c)).eval();
            if (solver_.info() != Eigen::Success)
                throw ComputationError("does not converge in " + std::to_string(solver_.iterations()) + " iterations");
            iterations += solver_.iterations();
        }
        return static_cast<int>(iterations);
    }

  private:
    static Eigen::Map<const Matrix> view(const WholeSystem& system)
    {
        const SparsePattern& pattern = system.pattern();
        return {system.n(),          system.n(),
                pattern.n_entries(), pattern.column_offsets.data(),
                pattern.rows.data(), system.values().data()};
    }

    SystemForm form_;
    Solver solver_;
};

using Jacobi = Eigen::DiagonalPreconditioner<double>;
// AMD instead of the natural order was no faster on 100,000 vertices.
using IncompleteCholesky = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
using IncompleteLu = Eigen::IncompleteLUT<double, int>;

}  // namespace

std::unique_ptr<PeerSolver> make_krylov_solver(Method method, Laplacian laplacian, double tolerance, int threads)
{
    if (laplacian != Laplacian::PtackovaVelho)
        return std::make_unique<Krylov<Eigen::ConjugateGradient<Matrix, both_triangles, IncompleteCholesky>>>(
            SystemForm::Symmetric, tolerance, threads);
    if (method == Method::Krylov)
        return std::make_unique<Krylov<Eigen::BiCGSTAB<Matrix, Jacobi>>>(SystemForm::AsTheyStand, tolerance, threads);
    return std::make_unique<Krylov<Eigen::BiCGSTAB<Matrix, IncompleteLu>>>(SystemForm::AsTheyStand, tolerance, threads);
}

}  // namespace seamflow
