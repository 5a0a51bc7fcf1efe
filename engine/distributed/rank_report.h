#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/metrics/length_statistics.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Measures of one state of a mesh that ranks share: the same on all ranks, and for any number of them.
struct RankMeasures {
    /// Of all faces, length².
    double area = 0.0;
    /// Length³; empty where the faces enclose none (see encloses_volume).
    std::optional<double> volume = {};
    /// Length of the edges, those between two faces counting twice.
    double mean_edge = 0.0;
    /// How far the last step moved the vertices of faces, in units of length.
    LengthStatistics displacement = {};
};

/// One step as a rank sees it.
struct RankStepReport {
    /// Wall-clock time.
    double seconds = 0.0;
    /// What the rank has sent to others.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    /// Of a converged step, of all ranks: its iterations, and the remaining residual.
    std::optional<int> iterations = {};
    std::optional<double> residual = {};
    /// With `measures`: as StepReport::estimated_v_max, by the mean edge of the whole mesh.
    std::optional<double> estimated_v_max = {};
    /// With ReportOptions::measures: the mesh after the step.
    std::optional<RankMeasures> measures = {};
};

/// What a distributed flow did.
struct RankReport {
    /// Of the whole mesh.
    Index sub_meshes = 0;
    Index colours = 0;
    std::int64_t interface_vertices = 0;
    /// Of the whole mesh: vertices held because the mesh is not manifold there, and faces that repeat others, which
    /// take no part in the flow.
    std::int64_t non_manifold_vertices = 0;
    std::int64_t repeated_faces = 0;
    /// Of this rank: the vertices of its sub-meshes, and those that it knows of others.
    Index vertices = 0;
    Index foreign_vertices = 0;
    /// All that is done before the first step, wall-clock time.
    double setup_seconds = 0.0;
    /// With ReportOptions::measures: the mesh before the first step.
    std::optional<RankMeasures> before = {};
    /// The steps of this flow: not those before the state that it resumed from.
    std::vector<RankStepReport> steps;
    /// With ReportOptions::measures: the mesh after all steps.
    std::optional<RankMeasures> after = {};
    /// As that of FlowReport.
    ConvergenceReport convergence = {};
    /// As those of FlowReport, of the whole mesh.
    std::vector<std::string> remarks;
};

/// What ranks need to resume after a complete step as if they had not ended: see RankStepState::capture. It belongs to
/// the mesh as it was before the first step, and to the options.
struct RankFlowState {
    /// Number of the step; those after it are taken.
    int step = 0;
    /// This rank's share: ranges of all ranks, in their order, make up the mesh. #V of the range by 3, near the origin,
    /// where the flow runs; arbitrary for vertices without faces.
    Points vertices = Points(0, 3);
    /// What else the next step needs: #V of the range by 3 each, 0 for vertices of which it needs nothing; and
    /// numbers, the same on all ranks.
    std::vector<Points> arrays = {};
    std::vector<double> numbers = {};
};

}  // namespace seamflow
