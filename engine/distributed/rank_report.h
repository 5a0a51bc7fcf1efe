#pragma once

#include <cstdint>
#include <optional>
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

/// What a rank has sent to others during a step.
struct RankTraffic {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
};

/// What a distributed flow did.
struct RankReport {
    /// Of the whole mesh, as of one process: sub-meshes in ascending order of their numbers, resources and seconds of
    /// tasks added up over all ranks, wall-clock times as this rank sees them. Its vertices are those of faces.
    /// Labels, fixed_vertices, moved_with, and the displacement of all steps together are left out. Steps are those of
    /// this flow, not those before the state that it resumed from.
    FlowReport flow;
    /// Of this rank: the vertices of its sub-meshes, and those that it knows of others.
    Index vertices = 0;
    Index foreign_vertices = 0;
    /// Of this rank, for each step.
    std::vector<RankTraffic> traffic;
    /// With ReportOptions::measures: the mesh before the first step, and after all.
    std::optional<RankMeasures> before = {};
    std::optional<RankMeasures> after = {};
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
