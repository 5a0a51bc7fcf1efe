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

/// Seconds. `assemble` to `correct` are summed over all tasks and threads; the others are wall-clock time.
struct PhaseSeconds {
    double cut = 0.0;
    double analyse = 0.0;
    double assemble = 0.0;
    double factorise = 0.0;
    double solve = 0.0;
    double correct = 0.0;
    /// The equation on Γ, with AccuracyOptions::tolerance: wall-clock time.
    double interface = 0.0;
    /// All steps.
    double step = 0.0;
    /// The whole call, without the undecomposed flow that ReportOptions::reference asks for.
    double total = 0.0;

    /// Adds the time spent in tasks, and on the equation on Γ.
    void add_tasks(const PhaseSeconds& further)
    {
        assemble += further.assemble;
        factorise += further.factorise;
        solve += further.solve;
        correct += further.correct;
        interface += further.interface;
    }
};

/// How far a flow carried the vertices along the surface and out of it, in units of length. Only the former deforms a
/// texture on the mesh.
struct TotalDisplacement {
    /// Per vertex, the sum over all steps of the lengths of both parts: all its movement, there and back.
    DisplacementStatistics path;
    /// Per vertex, the length of the sum of the tangential parts as vectors: how far the vertex, and the texture with
    /// it, was dragged along the surface in the end.
    LengthStatistics drift;
};

/// One step.
struct StepReport {
    /// Wall-clock time.
    double seconds = 0.0;
    /// Largest length of the mean curvature vector ΔV over all interior vertices that may move, in 1/length (where it
    /// is finite: edges or faces that the flow has shrunk to nothing do not count).
    double max_mean_curvature_before = 0.0;
    double max_mean_curvature_after = 0.0;
    /// How far the vertices moved in this step, in units of length (see split_displacement).
    DisplacementStatistics displacement;
    /// With the classical conditions, how far apart the copies of Γ are after this step: over the vertices of Γ, the
    /// largest distance between two copies, in units of length.
    std::optional<LengthStatistics> gap;
    /// Of a converged step: its iterations, and the remaining residual.
    std::optional<int> iterations;
    std::optional<double> residual;
    /// An estimate of the largest distance to the undecomposed flow after this step, VertexDistance::max. For sweeps it
    /// follows from the residual of the whole mesh's rows, for converged steps from their residual.
    /// Only for backward Euler steps, and not with Conditions::Schwarz, whose sub-meshes overlap.
    std::optional<double> estimated_v_max;  ///< in mean edge lengths
    /// Distance to the undecomposed flow after this step, with ReportOptions::reference.
    std::optional<VertexDistance> distance;
    /// The same as H_: from the vertices of the undecomposed flow's mesh to the surface (see surface_distance), in
    /// units of length.
    std::optional<LengthStatistics> surface_distance;
    /// Wall-clock time of the undecomposed step, with ReportOptions::reference.
    std::optional<double> reference_seconds;
};

/// The mesh that flowed.
struct MeshReport {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    /// Vertices that stay where they are, for whatever reason: boundary, not manifold, without faces, or asked for.
    std::int64_t fixed_vertices = 0;
    /// Those held fixed because they lie on an edge of three or more faces, or where two fans of faces touch.
    std::int64_t non_manifold_vertices = 0;
    /// Those of kind Junction, which move unless they are held for another reason (see Junctions).
    std::int64_t junction_vertices = 0;
    /// The faces that have the same vertices as an earlier one and took no part in the flow, ascending.
    std::vector<Index> repeated_faces;
    /// Those that no face uses, ascending: they stay, and count in no box and no mean.
    std::vector<Index> unused_vertices;
    /// #V: the lowest of the vertices joined with each along seams (see MotionOptions::weld), its own number if there
    /// are no others. Empty if none were joined.
    std::vector<Index> moved_with;
};

/// One sub-mesh.
struct SubMeshReport {
    Index faces = 0;
    /// With those of the interface, and of the overlap of Conditions::Schwarz.
    Index vertices = 0;
    /// Colour 0 solves first in even steps.
    Index colour = 0;
    /// Robin parameter, in 1/length; 0 without interface, and with conditions that have none.
    double p = 0.0;
    /// What factorised it; Automatic: nothing did. And how often its equations were nearly singular.
    Factorisation factorisation = Factorisation::Automatic;
    Index n_nearly_singular = 0;
};

/// How the mesh was cut.
struct CutReport {
    std::vector<SubMeshReport> sub_meshes;
    /// Sub-mesh of every face after repair; n of sub_meshes for those that no vertex of a region moves.
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

/// Whether steps were converged, and how many missed the tolerance.
struct ConvergenceReport {
    /// How steps were taken: one of Sweep, Converged, ConjugateGradients and Undecomposed.
    Approach approach = Approach::Sweep;
    /// The tolerance of the steps, asked for or chosen; empty if they were sweeps.
    std::optional<double> tolerance;
    /// Converged steps that did not reach the tolerance, and those of them where more iterations would not have helped.
    int steps_short_of_tolerance = 0;
    int steps_stagnated = 0;
};

/// The noise that was found where FlowOptions::denoise removes it.
struct NoiseReport {
    /// Along the normals, root mean square over the vertices that have some, in lengths of the edges there.
    double deviation = 0.0;
    /// The fraction of vertices that have some.
    double part = 0.0;
};

/// Resources that the flow used.
struct ResourceReport {
    int threads = 0;
    /// How many factorisations of sub-meshes may live at once, and the bytes that were set aside for the
    /// library's own; CHOLMOD's and UMFPACK's are not counted.
    Index live_factors = 0;
    std::size_t factor_memory_bytes = 0;
    /// How many sub-meshes had a factor in single precision in the last step.
    Index single_factors = 0;
};

/// What one of several ranks that shared the steps did.
struct RankRecord {
    /// Vertices whose positions it found, and others of the faces around its sub-meshes.
    std::int64_t vertices = 0;
    std::int64_t foreign_vertices = 0;
    /// What it sent in all steps together.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::int64_t peak_memory_bytes = 0;
    std::int64_t threads = 0;
};

/// What a flow did.
struct FlowReport {
    MeshReport mesh;
    CutReport cut;
    /// With FlowOptions::denoise, after the first step.
    std::optional<NoiseReport> noise;
    /// dt, in length².
    double time_step = 0.0;
    ConvergenceReport convergence;
    ResourceReport resources;
    /// Empty where one process took all steps (see FlowControl::ranks).
    std::vector<RankRecord> ranks;
    PhaseSeconds seconds;
    std::vector<StepReport> steps;
    /// With ReportOptions::measures.
    std::optional<TotalDisplacement> displacement;
    /// The sub-meshes at the end, none sharing a vertex with another, with ReportOptions::keep_gaps: the faces in the
    /// order of the mesh; its vertices first, then the further copies.
    std::optional<PolygonMesh> separated;
    /// With ReportOptions::record_schedule, of a flow in backward Euler steps.
    std::optional<Schedule> schedule;
    /// How steps are taken and why, where that was left open.
    std::vector<Remark> choices;
    /// For the user: a number of sub-meshes that was changed, vertices held fixed, and so on.
    std::vector<Remark> remarks;
};

struct FlowState;

/// What an observer sees after each step.
struct StepState {
    /// Number of the step, from 1.
    int step = 0;
    /// #V by 3, the positions after the step.
    const Points& positions;
    const StepReport& report;
    /// See FlowReport::separated; null without ReportOptions::keep_gaps.
    const PolygonMesh* separated = nullptr;
    /// #V by 3, those of the undecomposed flow, rescaled as well; null without ReportOptions::reference.
    const Points* reference_positions = nullptr;
    /// Copies everything that the flow needs to resume from here (see FlowState). May be called while the observer
    /// runs.
    std::function<FlowState()> capture = {};
};

/// Called after each step, in the thread that called the flow.
using StepObserver = std::function<void(const StepState&)>;

}  // namespace seamflow
