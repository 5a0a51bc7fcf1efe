#pragma once

#include <filesystem>
#include <memory>

#include "engine/measure/flow_report.h"
#include "engine/state/flow_state.h"
#include "engine/tasks/stopwatch.h"
#include "samples/options/smooth_surface.h"

namespace seamflow {

/// The steps after which a checkpoint is saved: every `steps`, and only if the last one is `seconds` old, and saving it
/// took at most a certain part of the time since the one before it.
struct CheckpointPeriod {
    int steps = 1;
    double seconds = 0.0;
    /// 1: any part.
    double most_of_time = 1.0;
};

/// The checkpoint of a run in a folder of its own, always that of the latest saved step.
class Checkpoints {
  public:
    Checkpoints(const std::filesystem::path& folder, const CheckpointPeriod& period);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// Creates the folder if it does not exist, and reads the state that an earlier run has saved there, if any.
    /// @param mesh, options as the flow gets them.
    /// @returns null if there is no checkpoint.
    /// @throws OutputError if the folder cannot be created; InputError and OptionError, naming the file, if it is
    ///         damaged or belongs to another input or other options.
    std::shared_ptr<const FlowState> find(const PolygonMesh& mesh, const AllOptions& options) const;

    /// Saves the state after a step if the period or the end of the run requires it.
    /// @throws OutputError.
    void save_if_due(const StepState& state, bool is_last);

    /// The step that this object saved last; 0: none.
    [[nodiscard]] int step() const { return step_; }

    /// Wall-clock time that saving has taken.
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    std::filesystem::path file_;
    CheckpointPeriod period_;
    Stopwatch since_kept_;
    int step_ = 0;
    double seconds_ = 0.0;
    double seconds_of_last_ = 0.0;
};

}  // namespace seamflow
