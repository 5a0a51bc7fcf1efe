#pragma once

#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "engine/diffuse.h"
#include "engine/measure/flow_report.h"
#include "partition/formats/data_file.h"
#include "samples/files/checkpoints.h"
#include "samples/files/step_pattern.h"
#include "samples/options/smooth_request.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// What is to be done with fields on a surface that stays.
struct FieldRequest {
    /// Those that diffuse; empty: none.
    std::vector<std::string> names;
    FieldOptions options;
    /// File with the vertices to measure geodesic distances from; empty: none are measured.
    DataFile from;

    [[nodiscard]] bool exists() const { return !names.empty() || !from.empty(); }
};

/// The command line of `smooth` or `smooth-distributed`.
struct SmoothCommand : SmoothRequest {
    /// The name of the program.
    std::string program = "smooth";
    std::filesystem::path input;
    std::filesystem::path output;
    /// Inputs whose borders coincide, in the order of their names, and the folder for their results, in place of
    /// `input` and `output`. Empty: there is one input.
    std::vector<std::filesystem::path> tiles;
    std::filesystem::path out_dir;
    FieldRequest fields;
    /// Files; empty: none.
    std::filesystem::path labels;
    DataFile fix;
    std::filesystem::path parts;
    std::filesystem::path report;
    std::filesystem::path csv;
    std::filesystem::path trace;
    std::filesystem::path task_graph;
    std::filesystem::path html;
    /// The property of vertices that marks fixed ones, if `fix` is a PLY file.
    std::string fix_property = "fixed";
    /// File with edges that are kept (see MotionOptions::feature_edges); the input if it has them; empty: none.
    DataFile edges;
    bool edges_from_file = false;
    /// A file with the w of an attachment, and if that is a PLY file, the property of vertices that holds it.
    DataFile attach_weights;
    std::string attach_property = "weight";
    /// The file with the region that moves, which may be the input, and if that is a PLY file, the property of vertices
    /// that holds it. Empty: everything moves.
    DataFile region;
    std::string region_property = "region";
    /// The folder of the checkpoint; empty: none is kept.
    std::filesystem::path checkpoint;
    CheckpointPeriod checkpoint_period{.most_of_time = 0.1};
    /// Whether to print only errors; and details of each step and task.
    bool quiet = false;
    bool verbose = false;
    /// Where messages go: nowhere with --quiet, to standard error where a result takes standard output.
    std::ostream* messages = &std::cout;
    /// Where to write the mesh after every step.
    std::optional<StepPattern> every_step;
};

}  // namespace seamflow
