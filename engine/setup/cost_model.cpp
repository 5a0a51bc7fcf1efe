#include "engine/setup/cost_model.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

/// A time per vertex on two cores, in nanoseconds: a constant, and a time per off-diagonal coefficient of the row; and
/// the fraction of the time in which one core works alone.
struct PerVertex {
    double constant;
    double per_coefficient;
    double serial;

    [[nodiscard]] double of(const FlowSize& size) const
    {
        return 1e-9 * size.vertices * (constant + per_coefficient * size.rows.length) * scale(size.cores);
    }

    [[nodiscard]] double scale(int cores) const { return serial + (1.0 - serial) * 2.0 / cores; }
};

/// Iterations are bound by memory. Sixteen cores still got data at full speed; more than this many cores are assumed to
/// share the memory bandwidth of this many.
constexpr int most_cores_fed = 32;
constexpr PerVertex iteration{3.5, 1.1, 0.02};
/// The overhead of an iteration, in seconds, however few its vertices: three loops begin and end.
constexpr double seconds_per_iteration = 3e-5;
constexpr PerVertex setup_of_conjugate_gradients{150.0, 30.0, 0.44};
constexpr PerVertex step_of_conjugate_gradients{40.0, 4.0, 0.03};

constexpr PerVertex setup_of_sweeps{300.0, 200.0, 0.22};
constexpr PerVertex step_of_sweeps{80.0, 14.0, 0.03};
constexpr PerVertex step_of_converged{100.0, 18.0, 0.05};
constexpr PerVertex interface_iteration{10.0, 0.0, 0.05};
/// A mesh with at least this many vertices is cut by clusters of faces, which makes the set-up per vertex cheaper by
/// this factor.
constexpr Index large_mesh = 250'000;
constexpr double part_of_setup_if_large = 0.6;

constexpr PerVertex setup_of_undecomposed{400.0, 55.0, 0.6};
/// For a mesh of `reference_vertices`. Factors grow faster than meshes: in larger ones the time per vertex grows by
/// this power of their size.
constexpr PerVertex step_of_undecomposed{0.0, 45.0, 0.45};
constexpr double reference_vertices = 10'000.0;
constexpr double growth_of_factors = 0.22;

/// The cost of a further solution with the same factor, as a fraction of a step.
constexpr double part_of_solution = 0.3;

/// The number of iterations for each factor of e in the residual is this factor times a power of the condition number,
/// with the diagonal as preconditioner. Theory has the power ½; the observed numbers grow slightly more slowly.
constexpr double iterations_of_one = 0.315;
constexpr double growth_of_iterations = 0.4;
/// The number of iterations on Γ for each factor of e in the residual.
constexpr double interface_iterations = 0.6;

/// The number of steps within which set-up must pay.
constexpr int steps_ahead = 3;
/// The most growth of iterations from step to step that is extrapolated: numbers that grow faster are still small.
constexpr double most_growth = 1.3;
/// The most vertices of a factorised mesh: its peak is about 600 MB. No cost makes up for a machine that runs out of
/// memory.
constexpr Index largest_factor = 500'000;

/// The seconds of the iterations of one solution by conjugate gradients.
double seconds_of_iterations(const FlowSize& size, double iterations)
{
    FlowSize fed = size;
    fed.cores = std::min(size.cores, most_cores_fed);
    return iterations * (seconds_per_iteration + iteration.of(fed));
}

}  // namespace

double predicted_iterations(const FlowSize& size, double tolerance)
{
    // The diagonal as preconditioner makes the largest eigenvalue about 2 (see RowAverages::stiffness).
    const double condition = 2.0 * (1.0 + size.time_step * size.rows.stiffness);
    return iterations_of_one * std::pow(condition, growth_of_iterations) * std::log(2.0 / tolerance);
}

PredictedCost predict_cost(Approach approach, const FlowSize& size, std::optional<double> tolerance)
{
    PredictedCost cost{.approach = approach, .tolerance = tolerance};
    const double further_solutions = 1.0 + part_of_solution * (size.solutions - 1);
    const double reduction = tolerance ? -std::log(*tolerance) : 0.0;
    switch (approach) {
    case Approach::ConjugateGradients:
        cost.setup = setup_of_conjugate_gradients.of(size);
        cost.step = step_of_conjugate_gradients.of(size) +
                    size.solutions * seconds_of_iterations(size, predicted_iterations(size, tolerance.value_or(1.0)));
        break;
    case Approach::Undecomposed:
        cost.setup = setup_of_undecomposed.of(size);
        cost.step = step_of_undecomposed.of(size) *
                    std::pow(std::max(size.vertices / reference_vertices, 1.0), growth_of_factors) * further_solutions;
        break;
    default:
        cost.setup = setup_of_sweeps.of(size) * (size.vertices < large_mesh ? 1.0 : part_of_setup_if_large);
        cost.step = tolerance
                        ? step_of_converged.of(size) + interface_iterations * reduction * interface_iteration.of(size)
                        : step_of_sweeps.of(size);
        cost.step *= further_solutions;
        break;
    }
    return cost;
}

bool pays_to_factorise(const FlowSize& size, const StepIterations& iterations)
{
    if (size.vertices > largest_factor)
        return false;
    const double growth =
        std::clamp(static_cast<double>(iterations.last) / std::max(iterations.before, 1), 1.0, most_growth);
    double expected = iterations.last;
    double by_gradients = 0.0;
    for (int i = 0; i < steps_ahead; ++i) {
        expected = std::min(growth * expected, static_cast<double>(iterations.most));
        by_gradients += step_of_conjugate_gradients.of(size) + seconds_of_iterations(size, expected);
    }
    return predict_cost(Approach::Undecomposed, size).of(steps_ahead) < by_gradients;
}

std::vector<CostConstant> cost_constants()
{
    const auto named = [](std::string_view name, const PerVertex& cost) -> CostConstant {
        return {name, cost.constant, cost.per_coefficient, cost.serial};
    };
    return {named("cg: setup", setup_of_conjugate_gradients),
            named("cg: step without iterations", step_of_conjugate_gradients),
            named("cg: iteration", iteration),
            named("sweep and converged: setup", setup_of_sweeps),
            named("sweep: step", step_of_sweeps),
            named("converged: step without iterations", step_of_converged),
            named("converged: iteration", interface_iteration),
            named("undecomposed: setup", setup_of_undecomposed),
            named("undecomposed: step, 10000 vertices", step_of_undecomposed)};
}

}  // namespace seamflow
