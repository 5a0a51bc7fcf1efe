#pragma once

#include <filesystem>
#include <memory>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/state/flow_state.h"
#include "engine/tasks/stopwatch.h"

namespace seamflow {

/// After which steps a checkpoint is kept: every so many, and only if the last one is so many seconds old.
struct CheckpointPeriod {
    int steps = 1;
    double seconds = 0.0;
};

/// The checkpoint of a run in a folder of its own, always that of the latest of the steps that are kept.
class Checkpoints {
  public:
    Checkpoints(const std::filesystem::path& folder, const CheckpointPeriod& period);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// Makes the folder if it is not there, and finds where the run was, if it has been there before.
    /// @param mesh, options as the flow gets them.
    /// @returns nothing where there is no checkpoint.
    /// @throws OutputError if there can be no folder; InputError and OptionError, naming the file, if it is damaged or
    ///         belongs to another input or other options.
    std::shared_ptr<const FlowState> find(const PolygonMesh& mesh, const FlowOptions& options) const;

    /// Keeps the state after a step where the period or the end of the run asks for it.
    /// @throws OutputError.
    void keep(const StepState& state, bool is_last);

    /// The step that was last kept by this object; 0: none.
    [[nodiscard]] int step() const { return step_; }

  private:
    std::filesystem::path file_;
    CheckpointPeriod period_;
    Stopwatch since_kept_;
    int step_ = 0;
};

}  // namespace seamflow
