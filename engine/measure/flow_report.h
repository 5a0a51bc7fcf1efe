#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/run_report.h"
#include "engine/options/approach.h"
#include "engine/tasks/schedule.h"
#include "partition/polygon_mesh.h"
#include "solvers/direct/factorisation.h"

namespace seamflow {

/// The report on one sub-mesh.
struct SubMeshReport {
    Index faces = 0;
    /// The number of its vertices, including the interface, and the overlap of Conditions::Schwarz.
    Index vertices = 0;
    /// Its turn in a sweep forward: colour 0 solves first in the first step; in a sweep backward, last.
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
    /// #F: the sub-mesh of every face after repair. Faces that were left out because no vertex of them moves have the
    /// label n_sub_meshes().
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
    /// The number of vertices whose positions the rank sent to rank 0; and of the further vertices that it knew, in its
    /// sub-meshes and around them.
    std::int64_t vertices = 0;
    std::int64_t foreign_vertices = 0;
    /// The number of messages that the rank sent in all steps, and their bytes.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::int64_t peak_memory_bytes = 0;
    std::int64_t threads = 0;
};

/// The report on a flow.
struct FlowReport : RunReport {
    CutReport cut;
    /// dt, in length².
    double time_step = 0.0;
    ConvergenceReport convergence;
    ResourceReport resources;
    /// One per rank; empty if one process took all steps (see FlowControl::ranks).
    std::vector<RankRecord> ranks;
    /// The sub-meshes at the end, none sharing a vertex with another, with ReportOptions::keep_gaps. Faces are in the
    /// order of the mesh; its vertices come first, then the additional copies of vertices.
    std::optional<PolygonMesh> separated;
    /// Only with ReportOptions::record_schedule, for backward Euler steps.
    std::optional<Schedule> schedule;
};

}  // namespace seamflow
