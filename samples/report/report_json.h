#pragma once

#include <string>
#include <string_view>

#include "engine/measure/flow_report.h"
#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"
#include "samples/options/smooth_surface.h"
#include "samples/process/exit_status.h"
#include "samples/report/comparison.h"
#include "samples/report/run_record.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

/// REPORT.json of `smooth` and `smooth-distributed`. All numbers read back to the same double; a number that is not
/// finite becomes null. v_mean, v_rms and v_max are in mean edge lengths of the undecomposed flow's mesh,
/// v_mean_absolute and so on in units of length; displacements are in mean edge lengths of the input.
/// @param options with the amount.
std::string smooth_report_json(const RunRecord& run, const AllOptions& options, const SmoothReport& report);

/// STEPS.csv of --csv: one row per step, with all keys of steps in the report, and the smallest and the largest Robin
/// parameter p of sub-meshes, in 1/length. A cell is empty if there is no such number.
/// @param report that of `smooth` or `smooth-distributed`, as JSON.
std::string steps_csv(std::string_view report);

/// REPORT.json of a run that has failed: the files, the arguments and the error.
std::string smooth_failure_json(const RunRecord& run, const Failure& failure);

/// REPORT.json of `compare`; the same units. Values that were not measured have no keys.
std::string compare_report_json(const Comparison& comparison);

/// All findings of `inspect`, as it prints them with --json.
/// @param noise empty if it is not measured: then it has no keys.
std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found,
                            const std::optional<SurfaceNoise>& noise);

}  // namespace seamflow
