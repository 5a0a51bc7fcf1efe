#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "partition/metrics/length_statistics.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

/// The report on a surface that moves in steps, by a flow or by denoise().
namespace seamflow {

/// Times in seconds. `assemble` to `correct` are summed over all tasks and threads; the others are wall-clock time.
struct PhaseSeconds {
    double cut = 0.0;
    double analyse = 0.0;
    double assemble = 0.0;
    double factorise = 0.0;
    double solve = 0.0;
    double correct = 0.0;
    /// The solution of the equation on Γ, with AccuracyOptions::tolerance: wall-clock time.
    double interface = 0.0;
    /// The time of all steps.
    double step = 0.0;
    /// The time of the whole call, without the undecomposed flow that ReportOptions::reference asks for.
    double total = 0.0;

    /// Adds the times of tasks, and of the equation on Γ.
    void add_tasks(const PhaseSeconds& further)
    {
        assemble += further.assemble;
        factorise += further.factorise;
        solve += further.solve;
        correct += further.correct;
        interface += further.interface;
    }
};

/// The displacement of the vertices by a whole flow, tangential to the surface and normal to it, in units of length.
/// Only tangential displacements deform a texture on the mesh.
struct TotalDisplacement {
    /// Statistics over the vertices of the lengths of their paths, there and back: of the sums over all steps of the
    /// lengths of the tangential and of the normal displacements.
    DisplacementStatistics path;
    /// Statistics over the vertices of the length of the vector sum of the tangential displacements: how far the
    /// vertex, and the texture with it, has slid along the surface in the end.
    LengthStatistics drift;
};

/// The report on one step.
struct StepReport {
    /// Wall-clock time, in seconds.
    double seconds = 0.0;
    /// Largest length of the mean curvature vector ΔV over all interior vertices that may move, in 1/length (where it
    /// is finite: edges or faces that the flow has shrunk to nothing do not count).
    double max_mean_curvature_before = 0.0;
    double max_mean_curvature_after = 0.0;
    /// The displacements of the vertices in this step, in units of length (see split_displacement).
    DisplacementStatistics displacement;
    /// With the classical conditions, the gap between the copies of Γ after this step: over the vertices of Γ, the
    /// largest distance between two copies, in units of length.
    std::optional<LengthStatistics> gap;
    /// Only for a converged step: the number of its iterations, and the residual at its end.
    std::optional<int> iterations;
    std::optional<double> residual;
    /// An estimate of the largest distance to the undecomposed flow after this step, VertexDistance::max. For sweeps it
    /// follows from the residual of the whole mesh's rows, for converged steps from their residual. Only for backward
    /// Euler steps, and not with Conditions::Schwarz, whose sub-meshes overlap.
    std::optional<double> estimated_v_max;  ///< in mean edge lengths
    /// Distance to the undecomposed flow after this step, with ReportOptions::reference.
    std::optional<VertexDistance> distance;
    /// H_mean and H_max: distances from the vertices of the undecomposed flow's mesh to the surface (see
    /// surface_distance), in units of length.
    std::optional<LengthStatistics> surface_distance;
    /// Wall-clock time of the undecomposed step, with ReportOptions::reference.
    std::optional<double> reference_seconds;
};

/// All fields of the report on a step, in the order in which checkpoints have them (see HasFields); the compiler
/// refuses a list that is not complete.
template <class Report>
requires std::is_same_v<std::remove_const_t<Report>, StepReport>
auto fields(Report& of)
{
    auto& [seconds, curvature_before, curvature_after, displacement, gap, iterations, residual, estimated, distance,
           surface_distance, reference_seconds] = of;
    return std::tie(seconds, curvature_before, curvature_after, displacement, gap, iterations, residual, estimated,
                    distance, surface_distance, reference_seconds);
}

/// The report on the mesh that flowed.
struct MeshReport {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    /// Vertices that do not move, for whatever reason: boundary, not manifold, without faces, or named by the user.
    std::int64_t fixed_vertices = 0;
    /// Vertices that are fixed because they lie on an edge of three or more faces that does not flow (see Junctions),
    /// or where two fans of faces touch.
    std::int64_t non_manifold_vertices = 0;
    /// Vertices of kind Junction, which move unless they are fixed for another reason (see Junctions).
    std::int64_t junction_vertices = 0;
    /// The faces that have the same vertices as an earlier one and took no part in the flow, ascending.
    std::vector<Index> repeated_faces;
    /// Vertices without faces, ascending: they do not move, and no box or mean includes them.
    std::vector<Index> unused_vertices;
    /// #V: the lowest of the vertices joined with each along seams (see MotionOptions::weld), its own number if there
    /// are no others. Empty if none were joined.
    std::vector<Index> moved_with;
};

/// The report that every run of steps gives.
struct RunReport {
    MeshReport mesh;
    PhaseSeconds seconds;
    std::vector<StepReport> steps;
    /// Only if displacements are measured.
    std::optional<TotalDisplacement> displacement;
    /// Choices that the options left open, each a sentence with the reason.
    std::vector<Remark> choices;
    /// Remarks for the user, a sentence each: a number of sub-meshes that was changed, vertices that were fixed, and so
    /// on.
    std::vector<Remark> remarks;
};

struct FlowState;

/// The state of a flow that an observer gets after each step.
struct StepState {
    /// Number of the step, from 1.
    int step = 0;
    /// #V by 3, the positions after the step.
    const Points& positions;
    const StepReport& report;
    /// The sub-meshes after the step, each with its own copy of Γ; null without ReportOptions::keep_gaps.
    const PolygonMesh* separated = nullptr;
    /// #V by 3: the positions of the undecomposed flow, rescaled as well; null without ReportOptions::reference.
    const Points* reference_positions = nullptr;
    /// Copies everything that the flow needs to resume from here (see FlowControl::resume and write_checkpoint). May be
    /// called while the observer runs.
    std::function<std::shared_ptr<const FlowState>()> capture = {};
};

/// Called after each step, in the thread that called the flow.
using StepObserver = std::function<void(const StepState&)>;

}  // namespace seamflow
