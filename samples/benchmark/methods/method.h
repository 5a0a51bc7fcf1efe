#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/state/archive.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The method that takes the steps.
enum class Method {
    /// mean_curvature_flow, by the approach of its options.
    Ours,
    /// One sparse factorisation of the whole mesh, by CHOLMOD.
    Cholmod,
    /// Conjugate gradients with Jacobi (see run_fused_cg).
    Gradients,
    /// Conjugate gradients with the algebraic multigrid BoomerAMG of hypre, in one thread.
    Amg,
};

/// Whether a method stops at MethodTask::tolerance instead of solving exactly.
bool is_iterative(Method method);

/// "ours", "cholmod", "cg" or "amg".
std::string_view name_of(Method method);

/// Everything that determines the steps of one method.
struct MethodTask {
    Method method = Method::Ours;
    /// Laplacian, time step, number of steps, threads (at least 1). All other options are for ours.
    FlowOptions options;
    /// Of an iterative method: the largest residual of a coordinate, relative to the length of its right-hand side, as
    /// libraries measure it; coordinates are relative to the centroid of the mesh, so that its place does not matter.
    double tolerance = 0.0;
    /// The file of the mesh, and that of the result.
    std::string input = {};
    std::string output = {};
};

/// The result of a method.
struct MethodResult {
    /// Why it failed; empty: it succeeded.
    std::string error;
    /// Once, before the first step.
    double setup_seconds = 0.0;
    /// Wall-clock time of each step.
    std::vector<double> steps;
    /// Iterations of all steps, and of all coordinates where those are iterated one by one.
    int iterations = 0;
    /// Of ours: how it took its steps, "sweep", "converged", "cg" or "undecomposed".
    std::string approach;
    /// Wall-clock time of the process that took the steps, from its start to its end.
    double process_seconds = 0.0;
    /// Of the process that took the steps, the mesh included.
    std::int64_t peak_memory_bytes = 0;
    /// #V by 3, after the last step.
    Points positions = Points(0, 3);

    /// Median time of the steps after the first, which warms up (of the first if there is no other).
    [[nodiscard]] double step_seconds() const;
    /// Setup and all steps.
    [[nodiscard]] double total_seconds() const;
};

/// The result of a method that failed.
MethodResult failed(std::string error);

/// What of a task another process needs (see archive.h).
auto fields(Is<MethodTask> auto& of)
{
    auto& options = of.options;
    return std::tie(of.method, options.laplacian, options.time_step, options.steps, options.cut.subdomains,
                    options.accuracy.tolerance, options.accuracy.approach, options.resources.memory_limit,
                    options.resources.threads, options.resources.tune_for, of.tolerance, of.input, of.output);
}

/// What that process reports; the positions are in a file of their own.
auto fields(Is<MethodResult> auto& of)
{
    return std::tie(of.error, of.setup_seconds, of.steps, of.iterations, of.approach, of.peak_memory_bytes);
}

}  // namespace seamflow
