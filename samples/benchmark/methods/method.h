#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/tasks/schedule_simulation.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The method that takes the steps.
enum class Method {
    /// mean_curvature_flow.
    Ours,
    /// The same by a given approach: one sweep, converged, by conjugate gradients; and in a single sub-mesh.
    OurSweep,
    OurConverged,
    OurCg,
    Undecomposed,
    /// One sparse factorisation of the whole mesh: Cholesky by CHOLMOD, LU by UMFPACK.
    Cholmod,
    Umfpack,
    /// Conjugate gradients with Jacobi (see run_fused_cg), and those of Eigen with incomplete Cholesky. For Δ_P, which
    /// is not symmetric, Eigen's BiCGSTAB with Jacobi, and with incomplete LU.
    Krylov,
    KrylovIncomplete,
    /// Conjugate gradients with the algebraic multigrid BoomerAMG of hypre, in one thread.
    Amg,
    /// smooth_shape of CGAL.
    SmoothShape,
};

/// Whether a method is mean_curvature_flow.
bool is_ours(Method method);

/// Whether a method stops at MethodTask::tolerance instead of solving exactly.
bool is_iterative(Method method);

/// Why a method cannot take steps of that Laplacian; empty: it can.
std::string why_not(Method method, Laplacian laplacian);

/// The name of a row of the table: "ours", "sweep", "converged", "our-cg", "undecomposed", "cholmod", "umfpack", "cg",
/// "cg-ic", "bicgstab", "bicgstab-ilut", "amg" or "cgal".
std::string_view title_of(Method method, Laplacian laplacian);

/// Everything that determines the steps of one method.
struct MethodTask {
    Method method = Method::Ours;
    /// Laplacian, time step, number of steps, threads (at least 1). All other options are for ours.
    FlowOptions options;
    /// Of an iterative method: the largest residual of a coordinate, relative to the length of its right-hand side, as
    /// libraries measure it; coordinates are relative to the centroid of the mesh, so that its place does not matter.
    double tolerance = 0.0;
    /// Of Ours: numbers of threads to replay the median step with (see simulate).
    std::vector<int> simulated_threads;
    /// If not empty: the mesh is read from one file, and the result written to the other.
    std::filesystem::path input = {};
    std::filesystem::path output = {};
};

/// Wall-clock time of one step and of its phases.
struct StepSeconds {
    double assemble = 0.0;
    /// Factorisation or preconditioner.
    double prepare = 0.0;
    double solve = 0.0;
    double total = 0.0;
};

/// The result of a method.
struct MethodResult {
    /// Why it failed; empty: it succeeded.
    std::string error;
    /// Once, before the first step.
    double setup_seconds = 0.0;
    /// One per step. Of Ours only `total`, because its tasks overlap.
    std::vector<StepSeconds> steps;
    /// Of Ours: per step, summed over all threads; `solve` includes the correction. Of others: of the median step.
    StepSeconds phases;
    /// Iterations of all steps, and of all coordinates where those are iterated one by one.
    int iterations = 0;
    /// Number of sub-meshes.
    Index subdomains = 1;
    /// Of ours: how it took its steps, "sweep", "converged", "cg" or "undecomposed".
    std::string approach;
    /// One for each of MethodTask::simulated_threads.
    std::vector<Simulation> simulations;
    /// Wall-clock time of the process that took the steps, from its start to its end.
    double process_seconds = 0.0;
    /// Of the process that took the steps, the mesh included.
    std::int64_t peak_memory_bytes = 0;
    std::vector<std::string> remarks;
    /// #V by 3, after the last step; empty if the method solves other equations than the task's.
    Points positions = Points(0, 3);

    /// Median time of the steps after the first, which warms up (of the first if there is no other).
    [[nodiscard]] double step_seconds() const;
    /// Setup and all steps.
    [[nodiscard]] double total_seconds() const;
};

/// The result of a method that failed.
MethodResult failed(std::string error);

/// The step, numbered from 0, whose time is the median of those after the first.
/// @pre there is a step.
std::size_t median_step(const std::vector<StepSeconds>& steps);

}  // namespace seamflow
