#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "samples/process/option_words.h"
#include "samples/report/flow_names.h"
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
    /// The options that it chose, as they would be typed.
    std::string chosen = {};
    /// Of the input.
    MeshScale scale = {};
    /// Of its steps.
    FlowNames names = {};
    /// The noise of the input in mean edge lengths, if the amount follows from it.
    std::optional<double> noise = {};
    /// Remarks to print before those of the flow.
    std::vector<Remark> remarks = {};
    /// Wall-clock time for reading all inputs and for writing all results, except for report and trace.
    double read_seconds = 0.0;
    double write_seconds = 0.0;
    /// For measuring the surface, and choosing how much to smooth.
    double choose_seconds = 0.0;
    /// For saving checkpoints.
    double checkpoint_seconds = 0.0;
    /// Of the whole run until now.
    double seconds = 0.0;
    /// The change from the input to the result.
    SurfaceChange surface = {};
    /// See FlowReport::ranks.
    std::vector<RankRecord> ranks = {};
    /// How steps were taken, and all remarks.
    std::vector<RemarkInWords> choices_in_words = {};
    std::vector<RemarkInWords> remarks_in_words = {};
};

/// Completes the record of a run by its report: by its ranks, and in the words of command lines by the approach, the
/// choices and the remarks.
void complete_record(RunRecord& run, const FlowReport& report);

/// The most memory that the process has held until now, of ranks the one that held most, in bytes.
std::int64_t peak_memory_of(const RunRecord& run);

}  // namespace seamflow
