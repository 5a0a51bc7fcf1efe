#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "samples/report/mesh_scale.h"
#include "samples/report/surface_change.h"

namespace seamflow {

/// The data of a run of `smooth` or `smooth-distributed` beyond the FlowReport.
struct RunRecord {
    std::string input = {};
    std::string output = {};
    /// As the user typed them.
    std::vector<std::string> arguments = {};
    /// The preset that chose options; empty: none.
    std::string preset = {};
    /// Of the input.
    MeshScale scale = {};
    /// Its noise in mean edge lengths, if the amount follows from it.
    std::optional<double> noise = {};
    /// Remarks to print before those of the flow.
    std::vector<Remark> remarks = {};
    /// Wall-clock time for reading all inputs and for writing all results, except for report and trace.
    double read_seconds = 0.0;
    double write_seconds = 0.0;
    /// For saving checkpoints.
    double checkpoint_seconds = 0.0;
    /// Of the whole run until now.
    double seconds = 0.0;
    /// The change from the input to the result.
    SurfaceChange surface = {};
    /// See FlowReport::ranks.
    std::vector<RankRecord> ranks = {};
};

/// The most memory that the process has held until now, of ranks the one that held most, in bytes.
std::int64_t peak_memory_of(const RunRecord& run);

}  // namespace seamflow
