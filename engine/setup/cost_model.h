#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/options/approach.h"
#include "solvers/laplacian/row_averages.h"

/// The cost of a flow by each way of taking its steps. The model was fitted once to measurements on two cores and on
/// sixteen (see samples/benchmark/speed.md), and is used only to compare the ways, so that results do not depend on the
/// machine.
namespace seamflow {

/// Input of the cost model.
struct FlowSize {
    Index vertices = 0;
    RowAverages rows;
    /// dt of a step, in length².
    double time_step = 0.0;
    int steps = 1;
    /// The number of solutions of each step (see n_solutions).
    int solutions = 1;
    int cores = 2;
};

/// Predicted cost of a way of taking steps.
struct PredictedCost {
    Approach approach = Approach::Automatic;
    /// The tolerance, if steps are converged.
    std::optional<double> tolerance = {};
    /// The times of the work before the first step, and of each step, in seconds.
    double setup = 0.0;
    double step = 0.0;

    /// The seconds of that many steps, with the work before the first.
    [[nodiscard]] double of(int steps) const { return setup + steps * step; }
};

/// The number of iterations of a solution by conjugate gradients: a power of the condition number times the logarithm
/// of 2 / tolerance, as in the bound of Saad (Iterative Methods for Sparse Linear Systems, 2003, eq. 6.128), fitted to
/// measurements.
double predicted_iterations(const FlowSize& size, double tolerance);

/// Predicts the cost of one way of taking steps.
/// @param approach Sweep, Converged, ConjugateGradients or Undecomposed.
/// @param tolerance of the steps, if they are converged.
PredictedCost predict_cost(Approach approach, const FlowSize& size, std::optional<double> tolerance = {});

/// The numbers of iterations by conjugate gradients of the last two steps.
struct StepIterations {
    int before = 0;
    int last = 0;
    /// The most iterations that a step may take.
    int most = 0;
};

/// Whether a few further steps would cost less by one factorisation of the whole mesh, set-up included, than by
/// conjugate gradients whose iterations grow at the present rate. The number of remaining steps is not used: a flow
/// that is resumed for more steps has the bits of an uninterrupted one.
bool pays_to_factorise(const FlowSize& size, const StepIterations& iterations);

/// One of the constants, for inspection: nanoseconds per vertex, and per coefficient of its row, on two cores; and the
/// fraction of the time in which one core works alone.
struct CostConstant {
    std::string_view name;
    double per_vertex = 0.0;
    double per_coefficient = 0.0;
    double serial = 0.0;
};

/// All constants that are times.
std::vector<CostConstant> cost_constants();

}  // namespace seamflow
