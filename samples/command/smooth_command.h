#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "samples/files/checkpoints.h"
#include "samples/files/step_pattern.h"
#include "samples/process/exit_status.h"
#include "samples/report/smoothing_request.h"

namespace seamflow {

/// The command line of `smooth`.
struct SmoothCommand {
    std::filesystem::path input;
    std::filesystem::path output;
    /// All of it but `labels`, `fixed_vertices`, what attaches vertices, and `time_step`, which need the mesh.
    FlowOptions options;
    SmoothingRequest amount;
    /// Whether the preset says how much, and the noise that it is to go by, if that is known.
    bool chooses_amount = false;
    std::optional<LengthOnMesh> noise;
    /// How far any vertex may end from where it was.
    std::optional<LengthOnMesh> within;
    /// Options that a preset has chosen, as they would be typed, without the amount: "--steps 3". Empty: there is none.
    std::string chosen;
    /// The name of that preset.
    std::string preset;
    /// Whether the iterations of a step are as many as the user says: then it is no failure that a step has no more.
    bool limits_iterations = false;
    /// Files; empty: none.
    std::filesystem::path labels;
    std::filesystem::path fix;
    std::filesystem::path parts;
    std::filesystem::path report;
    std::filesystem::path csv;
    std::filesystem::path trace;
    std::filesystem::path task_graph;
    std::filesystem::path html;
    /// The property of vertices that says which are fixed, where `fix` is a PLY file.
    std::string fix_property = "fixed";
    /// File with edges that are kept (see MotionOptions::feature_edges), or whether the input has them; empty: none.
    std::filesystem::path edges;
    bool edges_from_file = false;
    /// 1/√w of an attachment that is the same for all vertices, if not empty; or a file with w, and where that is a PLY
    /// file, the property of vertices that says it.
    std::optional<LengthOnMesh> attach;
    std::filesystem::path attach_weights;
    std::string attach_property = "weight";
    /// Within which distance vertices along seams move as one; empty: they do not.
    std::optional<LengthOnMesh> weld = LengthOnMesh{};
    /// The folder of the checkpoint; empty: none is kept.
    std::filesystem::path checkpoint;
    CheckpointPeriod checkpoint_period;
    /// Whether to print errors alone; and what each step and task did.
    bool quiet = false;
    bool verbose = false;
    /// Whether to count the pairs of faces that cross each other, before and after.
    bool self_intersections = false;
    /// Whether the number of threads was left open.
    bool chooses_threads = false;
    /// Where to write the mesh after every step.
    std::optional<StepPattern> every_step;
    /// What there is to say of the options, a sentence each.
    std::vector<std::string> remarks;
    /// As the user typed it.
    std::vector<std::string> arguments;
};

}  // namespace seamflow
