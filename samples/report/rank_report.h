#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/parts/slice_measures.h"
#include "engine/options/flow_options.h"
#include "samples/report/run_record.h"

/// The report of `smooth-distributed` on its run.
namespace seamflow {

/// The work of one rank.
struct RankRecord {
    std::int64_t vertices = 0;
    std::int64_t foreign_vertices = 0;
    /// In all steps together.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::int64_t peak_memory_bytes = 0;
    std::int64_t threads = 0;
};

/// The whole report, at rank 0.
struct DistributedRecord {
    RunRecord run;
    SharedMeshSize size;
    double time_step = 0.0;
    /// From reading to the first step, wall-clock time.
    double setup_seconds = 0.0;
    /// Of rank 0.
    RankReport report;
    std::vector<RankRecord> ranks;
    std::vector<std::string> choices;
    std::vector<std::string> remarks;
};

/// One line for a step.
/// @param steps their number. @param mean_edge of the input.
void print_rank_step(std::ostream& out, const RankStepState& state, int steps, double mean_edge);

/// Prints the choices, the cut, time and memory, remarks, where the result is, and how it differs from the input.
void print_distributed_result(std::ostream& out, const DistributedRecord& record);

/// REPORT.json, with the same names and units as that of `smooth`.
std::string distributed_report_json(const DistributedRecord& record, const FlowOptions& options);

}  // namespace seamflow
