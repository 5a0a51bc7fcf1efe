#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/tasks/schedule.h"
#include "partition/metrics/displacement.h"
#include "partition/metrics/length_statistics.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

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
    /// Per vertex, the sums over all steps of the lengths of its tangential and normal displacements: the path of the
    /// vertex, there and back.
    DisplacementStatistics path;
    /// Per vertex, the length of the vector sum of its tangential displacements: how far the vertex, and the texture
    /// with it, has slid along the surface in the end.
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
    /// follows from the residual of the whole mesh's rows, for converged steps from their residual.
    /// Only for backward Euler steps, and not with Conditions::Schwarz, whose sub-meshes overlap.
    std::optional<double> estimated_v_max;  ///< in mean edge lengths
    /// Distance to the undecomposed flow after this step, with ReportOptions::reference.
    std::optional<VertexDistance> distance;
    /// H_mean and H_max: distances from the vertices of the undecomposed flow's mesh to the surface (see
    /// surface_distance), in units of length.
    std::optional<LengthStatistics> surface_distance;
    /// Wall-clock time of the undecomposed step, with ReportOptions::reference.
    std::optional<double> reference_seconds;
};

/// The report on the mesh that flowed.
struct MeshReport {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    /// Vertices that do not move, for whatever reason: boundary, not manifold, without faces, or named by the user.
    std::int64_t fixed_vertices = 0;
    /// Vertices that are fixed because they lie on an edge of three or more faces, or where two fans of faces touch.
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

/// The report on one sub-mesh.
struct SubMeshReport {
    Index faces = 0;
    /// The number of its vertices, including the interface, and the overlap of Conditions::Schwarz.
    Index vertices = 0;
    /// Colour 0 solves first in even steps.
    Index colour = 0;
    /// Robin parameter, in 1/length; 0 without interface, and with conditions that have none.
    double p = 0.0;
    /// The solver that factorised it; Automatic: none did. And the number of its factorisations that were nearly
    /// singular.
    Factorisation factorisation = Factorisation::Automatic;
    Index n_nearly_singular = 0;
};

/// The report on the cut.
struct CutReport {
    std::vector<SubMeshReport> sub_meshes;
    /// #F: the sub-mesh of every face after repair. Faces in which no vertex of a region moves have the number of
    /// sub-meshes.
    std::vector<Index> labels;
    /// Number of vertices on the interface Γ.
    std::int64_t interface_vertices = 0;
    /// Faces moved to another sub-mesh so that each is connected and has one fan of faces around each of its vertices.
    Index repaired_faces = 0;

    [[nodiscard]] Index n_sub_meshes() const { return static_cast<Index>(sub_meshes.size()); }
    /// Colours are numbered from 0, and each is used.
    [[nodiscard]] Index n_colours() const
    {
        Index n = 0;
        for (const SubMeshReport& sub_mesh : sub_meshes)
            n = std::max(n, sub_mesh.colour + 1);
        return n;
    }
};

/// Whether steps were converged, and the number of steps that missed the tolerance.
struct ConvergenceReport {
    /// The way in which steps were taken: Sweep, Converged, ConjugateGradients or Undecomposed.
    Approach approach = Approach::Sweep;
    /// The tolerance of the steps, given or chosen; empty for sweeps.
    std::optional<double> tolerance;
    /// The number of converged steps that did not reach the tolerance, and of those in which more iterations would not
    /// have helped.
    int steps_short_of_tolerance = 0;
    int steps_stagnated = 0;
};

/// The noise that FlowOptions::denoise has removed.
struct NoiseReport {
    /// The root mean square of the noise along the normals, over the vertices that have noise, in lengths of the edges
    /// there.
    double deviation = 0.0;
    /// The fraction of vertices that have noise.
    double part = 0.0;
};

/// Resources that the flow used.
struct ResourceReport {
    int threads = 0;
    /// The most factorisations of sub-meshes that could live at once, and the bytes set aside for the library's own
    /// factors; the bytes of CHOLMOD's and UMFPACK's factors are not counted.
    Index live_factors = 0;
    std::size_t factor_memory_bytes = 0;
    /// The number of sub-meshes that had a factor in single precision in the last step.
    Index single_factors = 0;
};

/// The report on one of several ranks that shared the steps.
struct RankRecord {
    /// The number of vertices whose positions the rank computed; and of further vertices that it knew, of the faces
    /// around its sub-meshes.
    std::int64_t vertices = 0;
    std::int64_t foreign_vertices = 0;
    /// The number of messages that the rank sent in all steps, and their bytes.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::int64_t peak_memory_bytes = 0;
    std::int64_t threads = 0;
};

/// The report on a flow.
struct FlowReport {
    MeshReport mesh;
    CutReport cut;
    /// Only with FlowOptions::denoise, after the first step.
    std::optional<NoiseReport> noise;
    /// dt, in length².
    double time_step = 0.0;
    ConvergenceReport convergence;
    ResourceReport resources;
    /// One per rank; empty if one process took all steps (see FlowControl::ranks).
    std::vector<RankRecord> ranks;
    PhaseSeconds seconds;
    std::vector<StepReport> steps;
    /// Only with ReportOptions::measures.
    std::optional<TotalDisplacement> displacement;
    /// The sub-meshes at the end, none sharing a vertex with another, with ReportOptions::keep_gaps. Faces are in the
    /// order of the mesh; its vertices come first, then the additional copies of vertices.
    std::optional<PolygonMesh> separated;
    /// Only with ReportOptions::record_schedule, for backward Euler steps.
    std::optional<Schedule> schedule;
    /// The way in which steps are taken and the reason, if the options left it open; a sentence each.
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
    /// See FlowReport::separated; null without ReportOptions::keep_gaps.
    const PolygonMesh* separated = nullptr;
    /// #V by 3: the positions of the undecomposed flow, rescaled as well; null without ReportOptions::reference.
    const Points* reference_positions = nullptr;
    /// Copies everything that the flow needs to resume from here (see FlowState). May be called while the observer
    /// runs.
    std::function<FlowState()> capture = {};
};

/// Called after each step, in the thread that called the flow.
using StepObserver = std::function<void(const StepState&)>;

}  // namespace seamflow
