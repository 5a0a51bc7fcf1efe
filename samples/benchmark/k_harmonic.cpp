#include "samples/benchmark/k_harmonic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory_resource>
#include <ostream>
#include <span>
#include <utility>

#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "partition/errors.h"
#include "samples/benchmark/methods/whole_system.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/sparse/elimination_ordering.h"

namespace seamflow {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Seconds.
struct SolverTimes {
    double factor = 0.0;
    double solve = 0.0;
};

/// The equations A u = b of one k, at all vertices.
struct Equations {
    Matrix matrix;
    Columns right_hand_side;
};

/// M + dt K; its rows sum to M.
Matrix first_matrix(const PolygonMesh& mesh, const FlowOptions& flow)
{
    Topology topology = make_topology(mesh);
    for (const VertexKind kind : topology.kind)
        if (kind != VertexKind::Interior && kind != VertexKind::Boundary)
            throw InputError(
                "--k-harmonic needs a manifold mesh whose vertices all have faces: inspect names the others");
    std::fill(topology.fixed.begin(), topology.fixed.end(), 0);
    WholeSystem system(mesh, topology, flow.laplacian);
    system.assemble(mesh.vertices, flow.time_step);
    const SparsePattern& pattern = system.pattern();
    return Eigen::Map<const Matrix>(system.n(), system.n(), pattern.n_entries(), pattern.column_offsets.data(),
                                    pattern.rows.data(), system.values().data());
}

Equations make_equations(const PolygonMesh& mesh, const Matrix& first, int k)
{
    const Eigen::VectorXd mass = first * Eigen::VectorXd::Ones(first.cols());
    Matrix stiffness = first;
    for (Eigen::Index v = 0; v < first.cols(); ++v)
        stiffness.coeffRef(v, v) -= mass[v];
    const Matrix scaled = mass.cwiseInverse().asDiagonal() * stiffness;
    Matrix power = stiffness;
    for (int i = 1; i < k; ++i)
        power = (power * scaled).pruned();
    // Products of rounded numbers are symmetric up to rounding.
    Matrix matrix = 0.5 * (power + Matrix(power.transpose()));
    for (Eigen::Index v = 0; v < first.cols(); ++v)
        matrix.coeffRef(v, v) += mass[v];
    matrix.makeCompressed();
    return {std::move(matrix), mass.asDiagonal() * Columns(mesh.vertices)};
}

double backward_error(const Equations& equations, const Columns& u)
{
    const Columns residual = (equations.right_hand_side - equations.matrix * u).cwiseAbs();
    Columns size = equations.right_hand_side.cwiseAbs();
    size += equations.matrix.cwiseAbs() * u.cwiseAbs();
    return (residual.array() / size.array().max(std::numeric_limits<double>::min())).maxCoeff();
}

/// A linear flow has one matrix: its first step factorises and solves, the second one solves.
Columns solve_by_ours(const PolygonMesh& mesh, const FlowOptions& flow, int k, double tolerance, SolverTimes& times)
{
    FlowOptions options = flow;
    options.flow = FlowEquation::Linear;
    options.filter = Filter::Diffusion;
    options.order = k;
    options.steps = 2;
    options.motion.boundary = Boundary::Free;
    options.motion.weld.reset();
    options.accuracy = {.tolerance = tolerance, .approach = Approach::Converged};
    options.report.measures = false;
    PolygonMesh moved = mesh;
    Stopwatch watch;
    Flow steps(moved, options);
    steps.step();
    times.factor = watch.lap();
    const Columns solution = moved.vertices;
    watch.lap();
    steps.step();
    times.solve = watch.lap();
    times.factor -= times.solve;
    return solution;
}

Columns solve_by_cholmod(const Equations& equations, SolverTimes& times)
{
    Stopwatch watch;
    Eigen::CholmodSupernodalLLT<Matrix> cholmod;
    cholmod.cholmod().nmethods = 1;
    cholmod.cholmod().method[0].ordering = CHOLMOD_METIS;
    cholmod.compute(equations.matrix);
    if (cholmod.info() != Eigen::Success)
        throw ComputationError("the factorisation fails");
    times.factor = watch.lap();
    const Columns solution = cholmod.solve(equations.right_hand_side);
    times.solve = watch.lap();
    return solution;
}

SparsePattern pattern_of(const Matrix& matrix)
{
    const Eigen::Index n = matrix.cols();
    SparsePattern pattern;
    pattern.column_offsets.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + n + 1);
    pattern.rows.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    return pattern;
}

Columns solve_by_own_factor(const Equations& equations, SolverTimes& times)
{
    Stopwatch watch;
    const Matrix upper = equations.matrix.triangularView<Eigen::Upper>();
    const std::vector<Index> order = elimination_ordering(pattern_of(upper));
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> place_of(
        Eigen::Map<const Eigen::VectorXi>(order.data(), std::ssize(order)));
    place_of = place_of.inverse().eval();
    Matrix permuted;
    permuted = equations.matrix.twistedBy(place_of);
    const Matrix ordered = permuted.triangularView<Eigen::Upper>();
    const LdlSolver solver(pattern_of(ordered), {}, {}, run_in_parallel);
    LdlWorkspace workspace;
    const auto factor = solver.factorise<double>({ordered.valuePtr(), usize(static_cast<Index>(ordered.nonZeros()))},
                                                 *std::pmr::new_delete_resource(), workspace);
    if (!factor)
        throw ComputationError("the matrix is not positive definite up to rounding");
    times.factor = watch.lap();
    Columns solution = place_of * equations.right_hand_side;
    factor->solve(solution, solution, workspace);
    solution = (place_of.inverse() * solution).eval();
    times.solve = watch.lap();
    return solution;
}

/// To an error of 1e-8, if that can be reached in a minute.
Columns solve_by_gradients(const Equations& equations, SolverTimes& times)
{
    constexpr double wanted = 1e-8;
    constexpr double longest = 60.0;
    constexpr int iterations_at_once = 50;
    Stopwatch watch;
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper,
                             Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>>>
        gradients;
    gradients.compute(equations.matrix);
    if (gradients.info() != Eigen::Success)
        throw ComputationError("the incomplete factorisation fails");
    gradients.setTolerance(0.0);
    gradients.setMaxIterations(iterations_at_once);
    times.factor = watch.lap();
    Columns solution = Columns::Zero(equations.right_hand_side.rows(), 3);
    double error = backward_error(equations, solution);
    watch.lap();
    while (error > wanted) {
        if (times.solve > longest)
            throw ComputationError(fmt::format("an error of {:.1e} after {:.0f} s", error, times.solve));
        watch.lap();
        solution = gradients.solveWithGuess(equations.right_hand_side, solution).eval();
        times.solve += watch.lap();
        error = backward_error(equations, solution);
    }
    return solution;
}

nlohmann::ordered_json run(const Equations& equations, const std::function<Columns(SolverTimes&)>& solve)
{
    try {
        SolverTimes times;
        const double error = backward_error(equations, solve(times));
        if (!std::isfinite(error))
            throw ComputationError("the solution is not finite");
        return {{"factor_s", times.factor},
                {"solve_s", times.solve},
                {"both_s", times.factor + times.solve},
                {"backward_error", error}};
    } catch (const ComputationError& error) {
        return {{"error", error.what()}};
    }
}

}  // namespace

Table k_harmonic_table(std::ostream& out)
{
    return {out,
            {{"mesh", "mesh", 20},
             {"vertices", "vertices", 9},
             {"k", "k", 1},
             {"method", "method", 10},
             {"factor_s", "factor, s", 9},
             {"solve_s", "solve, s", 9},
             {"both_s", "both, s", 9},
             {"backward_error", "backward error", 14}}};
}

void add_k_harmonic(Table& table, const std::string& name, const PolygonMesh& mesh, const FlowOptions& flow,
                    const std::vector<int>& orders)
{
    const Matrix first = first_matrix(mesh, flow);
    for (const int k : orders) {
        const Equations equations = make_equations(mesh, first, k);
        const auto add = [&](const std::string& method, auto&& solve) {
            nlohmann::ordered_json row{{"mesh", name}, {"vertices", mesh.n_vertices()}, {"k", k}, {"method", method}};
            row.update(run(equations, solve));
            table.add(std::move(row));
        };
        for (const double tolerance : {1e-8, 1e-14})
            add(fmt::format("ours {:.0e}", tolerance),
                [&](SolverTimes& times) { return solve_by_ours(mesh, flow, k, tolerance, times); });
        add("cholmod", [&](SolverTimes& times) { return solve_by_cholmod(equations, times); });
        add("own LDL", [&](SolverTimes& times) { return solve_by_own_factor(equations, times); });
        add("cg-ic", [&](SolverTimes& times) { return solve_by_gradients(equations, times); });
    }
}

}  // namespace seamflow
