#include "samples/benchmark/methods/fused_cg.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/parallel_lists.h"
#include "partition/topology.h"
#include "solvers/laplacian/kernels.h"

namespace seamflow {

namespace {

/// The most that single precision leaves of a residual until it is renewed, so that it stays the true one.
constexpr double least_left = 1e-4;
constexpr int most_iterations = 20'000;

/// Three columns and a zero: a register.
using Row = Eigen::Array4f;
using Sums = Eigen::Array4d;

/// (M + dt K)(Vᵏ⁺¹ - Vᵏ) = -dt K Vᵏ, scaled from both sides by the roots of its diagonal: that is Jacobi.
struct Equations {
    std::vector<Index> offsets;
    std::vector<Index> columns;
    /// Off-diagonal entries; the diagonal is 1.
    std::vector<float> values;
    /// The factor of a row; 0 where a vertex stays.
    std::vector<double> scale;
    std::vector<Row> residual;
    /// Per column.
    Sums squared_residual = Sums::Zero();
    Sums squared_right_hand_side = Sums::Zero();
};

/// A mesh, and the Laplacian and dt of a task.
struct FusedFlow {
    const PolygonMesh& mesh;
    Topology topology;
    Laplacian laplacian;
    double time_step;
};

void list_neighbours(const FusedFlow& flow, Index v, std::vector<Index>& neighbours)
{
    neighbours.clear();
    for (const Index corner : flow.topology.corners_at(v))
        if (flow.laplacian == Laplacian::Fujiwara) {
            neighbours.push_back(flow.mesh.face_vertices[flow.topology.next(flow.mesh, corner)]);
            neighbours.push_back(flow.mesh.face_vertices[flow.topology.previous(flow.mesh, corner)]);
        } else {
            const auto face = flow.mesh.face(flow.topology.face_of[corner]);
            neighbours.insert(neighbours.end(), face.begin(), face.end());
        }
    sort_unique(neighbours);
    std::erase(neighbours, v);
}

Equations analyse(const FusedFlow& flow)
{
    const Index n = flow.mesh.n_vertices();
    Equations equations;
    const auto list = [&](Index v, std::vector<Index>& neighbours) {
        neighbours.clear();
        if (flow.topology.moves(v))
            list_neighbours(flow, v, neighbours);
    };
    make_lists_in_parallel(run_in_parallel, n, list, equations.offsets, equations.columns);
    equations.values.resize(equations.columns.size());
    equations.scale.assign(n, 0.0);
    equations.residual.assign(n, Row::Zero());
    return equations;
}

/// Calls entry(i, K_vw) for w the i-th column of row v, possibly several times.
/// @returns M_v.
template <class Entry>
double visit_row(const FusedFlow& flow, const Equations& equations, const Points& positions, Index v, Entry&& entry)
{
    const Index* const begin = equations.columns.data() + equations.offsets[v];
    const Index* const end = equations.columns.data() + equations.offsets[v + 1];
    double mass = 0.0;
    if (flow.laplacian == Laplacian::Fujiwara) {
        for (const Index* w = begin; w != end; ++w) {
            const double length = (positions.row(*w) - positions.row(v)).norm();
            entry(w - begin, -1.0 / length);
            mass += length;
        }
        return mass / static_cast<double>(end - begin);
    }
    for (const Index corner : flow.topology.corners_at(v)) {
        const Index f = flow.topology.face_of[corner];
        const auto corners = flow.mesh.face(f);
        const std::size_t own = usize(corner - flow.mesh.face_offsets[f]);
        const auto add = [&](const auto& face, std::size_t i) {
            const auto row = face.row(i, 1.0 / face.divisor());
            for (std::size_t k = 0; k < face.size(); ++k)
                if (k != i)
                    entry(std::find(begin, end, face.corner(k)) - begin, row(k));
            mass += face.mass(i);
        };
        if (flow.laplacian == Laplacian::VirtualRefinement)
            measure_corner<VirtualRefinement>(corners, own, positions, add);
        else
            measure_corner<AlexaWardetzky>(corners, own, positions, add);
    }
    return mass;
}

Row to_row(const Point& point)
{
    return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]), 0.0F};
}

Sums squares(const Point& point)
{
    return {point[0] * point[0], point[1] * point[1], point[2] * point[2], 0.0};
}

/// Matrix, first residual and norms for the positions Vᵏ.
void assemble(const FusedFlow& flow, const Points& before, const Point& centroid, Equations& equations)
{
    const Index n = flow.mesh.n_vertices();
    const double dt = flow.time_step;
    const Eigen::Array<double, 8, 1> zero = Eigen::Array<double, 8, 1>::Zero();
    const auto squares_of = [&](Index v) {
        Eigen::Array<double, 8, 1> sums = zero;
        if (!flow.topology.moves(v))
            return sums;
        const Index begin = equations.offsets[v];
        std::fill(equations.values.begin() + begin, equations.values.begin() + equations.offsets[v + 1], 0.0F);
        double diagonal = 0.0;
        Point residual = Point::Zero();
        Point known = Point::Zero();
        const double mass = visit_row(flow, equations, before, v, [&](std::ptrdiff_t i, double k) {
            const Index w = equations.columns[begin + i];
            equations.values[begin + i] += static_cast<float>(dt * k);
            diagonal -= dt * k;
            residual -= dt * k * (before.row(w) - before.row(v));
            if (!flow.topology.moves(w))
                known -= dt * k * (before.row(w) - centroid);
        });
        const double scale = 1.0 / std::sqrt(mass + diagonal);
        equations.scale[v] = scale;
        equations.residual[v] = to_row(scale * residual);
        sums << squares(scale * residual), squares(scale * (mass * (before.row(v) - centroid) + known));
        return sums;
    };
    const Eigen::Array<double, 8, 1> both = sum(run_in_parallel, n, squares_of, zero);
    equations.squared_residual = both.head<4>();
    equations.squared_right_hand_side = both.tail<4>();
    for_each(run_in_parallel, n, [&](Index v) {
        for (Index i = equations.offsets[v]; i < equations.offsets[v + 1]; ++i)
            equations.values[i] *= static_cast<float>(equations.scale[v] * equations.scale[equations.columns[i]]);
    });
}

/// The residual of positions after the step so far, in double precision.
void renew_residual(const FusedFlow& flow, const Points& before, const Points& after, Equations& equations)
{
    const double dt = flow.time_step;
    const auto squares_of = [&](Index v) -> Sums {
        if (!flow.topology.moves(v))
            return Sums::Zero();
        const Index* const columns = equations.columns.data() + equations.offsets[v];
        Point residual = Point::Zero();
        const double mass = visit_row(flow, equations, before, v, [&](std::ptrdiff_t i, double k) {
            residual -= dt * k * (after.row(columns[i]) - after.row(v));
        });
        residual = equations.scale[v] * (residual - mass * (after.row(v) - before.row(v)));
        equations.residual[v] = to_row(residual);
        return squares(residual);
    };
    equations.squared_residual = sum(run_in_parallel, flow.mesh.n_vertices(), squares_of, Sums(Sums::Zero()));
}

/// The vectors of conjugate gradients, each thread on its own range of the rows.
class Iteration {
  public:
    Iteration(Index n, int n_threads)
        : n_(n)
        , n_threads_(n_threads)
        , direction_(n)
        , product_(n)
        , solution_(n)
    {
    }

    [[nodiscard]] const Row& solution(Index v) const { return solution_[v]; }

    /// Conjugate gradients from 0 for the residual, which is overwritten.
    /// @param goal squared norms of the columns that suffice.
    /// @returns the number of iterations.
    int run(Equations& equations, const Sums& goal)
    {
        std::barrier<> barrier(n_threads_);
        std::vector<std::jthread> others;
        sums_.resize(n_threads_);
        for (int thread = 1; thread < n_threads_; ++thread)
            others.emplace_back([&, thread] { iterate(equations, goal, thread, barrier); });
        return iterate(equations, goal, 0, barrier);
    }

  private:
    struct alignas(64) ThreadSums {
        Sums products;
        Sums squares;
    };

    [[nodiscard]] Sums total(Sums ThreadSums::*sums) const
    {
        return std::accumulate(sums_.begin(), sums_.end(), Sums(Sums::Zero()),
                               [&](const Sums& sum, const ThreadSums& part) -> Sums { return sum + part.*sums; });
    }

    int iterate(Equations& equations, const Sums& goal, int thread, std::barrier<>& barrier)
    {
        const auto place = [&](int t) { return static_cast<Index>(std::int64_t{n_} * t / n_threads_); };
        const Index begin = place(thread);
        const Index end = place(thread + 1);
        std::vector<Row>& residual = equations.residual;
        for (Index v = begin; v < end; ++v) {
            direction_[v] = residual[v];
            solution_[v].setZero();
        }
        Sums squared = equations.squared_residual;
        int iterations = 0;
        for (; iterations < most_iterations && (squared > goal).any(); ++iterations) {
            barrier.arrive_and_wait();
            sums_[thread].products = multiply(equations, begin, end);
            barrier.arrive_and_wait();
            const Sums products = total(&ThreadSums::products);
            const Row alpha = (products > 0.0).select(squared / products, 0.0).cast<float>();
            Sums sum = Sums::Zero();
            for (Index v = begin; v < end; ++v) {
                residual[v] -= alpha * product_[v];
                sum += residual[v].square().cast<double>();
            }
            sums_[thread].squares = sum;
            barrier.arrive_and_wait();
            const Sums squared_before = std::exchange(squared, total(&ThreadSums::squares));
            const Row beta = (squared_before > 0.0).select(squared / squared_before, 0.0).cast<float>();
            for (Index v = begin; v < end; ++v) {
                solution_[v] += alpha * direction_[v];
                direction_[v] = residual[v] + beta * direction_[v];
            }
        }
        return iterations;
    }

    /// @returns the inner products of the direction and its product with the matrix.
    Sums multiply(const Equations& equations, Index begin, Index end)
    {
        Sums sum = Sums::Zero();
        for (Index v = begin; v < end; ++v) {
            Row q = direction_[v];
            for (Index i = equations.offsets[v]; i < equations.offsets[v + 1]; ++i)
                q += equations.values[i] * direction_[equations.columns[i]];
            sum += (direction_[v] * q).cast<double>();
            product_[v] = q;
        }
        return sum;
    }

    Index n_;
    int n_threads_;
    std::vector<Row> direction_;
    std::vector<Row> product_;
    std::vector<Row> solution_;
    std::vector<ThreadSums> sums_;
};

/// @param after receives the positions after the step.
/// @returns the number of iterations.
int solve(const FusedFlow& flow, const Points& before, double tolerance, Equations& equations, Iteration& iteration,
          Points& after)
{
    const Index n = flow.mesh.n_vertices();
    const Sums goal = tolerance * tolerance * equations.squared_right_hand_side;
    after = before;
    int iterations = 0;
    while ((equations.squared_residual > goal).any()) {
        // Makes the residual about 1 at each vertex.
        const double unit = std::sqrt(equations.squared_residual.sum() / n);
        for_each(run_in_parallel, n, [&](Index v) { equations.residual[v] /= static_cast<float>(unit); });
        equations.squared_residual /= unit * unit;
        const Sums least = least_left * least_left * equations.squared_residual;
        const Sums wanted = goal / (unit * unit);
        iterations += iteration.run(equations, wanted.max(least));
        for_each(run_in_parallel, n, [&](Index v) {
            after.row(v) +=
                unit * equations.scale[v] * iteration.solution(v).head<3>().cast<double>().matrix().transpose();
        });
        if ((wanted >= least).all())
            break;
        if (iterations >= most_iterations)
            throw ComputationError("does not converge in " + std::to_string(iterations) + " iterations");
        renew_residual(flow, before, after, equations);
    }
    return iterations;
}

}  // namespace

MethodResult run_fused_cg(const PolygonMesh& mesh, const MethodTask& task)
{
    MethodResult result;
    const FlowOptions& options = task.options;
    Workers workers(options.resources.threads);
    workers.execute([&] {
        Stopwatch watch;
        const FusedFlow flow{mesh, make_topology(mesh, run_in_parallel), options.laplacian, options.time_step};
        Equations equations = analyse(flow);
        Iteration iteration(mesh.n_vertices(), options.resources.threads);
        const Point centroid = mesh.vertices.colwise().mean();
        result.positions = mesh.vertices;
        Points after;
        result.setup_seconds = watch.lap();
        for (int step = 0; step < options.steps; ++step) {
            watch.lap();
            assemble(flow, result.positions, centroid, equations);
            result.iterations += solve(flow, result.positions, task.tolerance, equations, iteration, after);
            std::swap(result.positions, after);
            result.steps.push_back(watch.lap());
        }
    });
    return result;
}

}  // namespace seamflow
