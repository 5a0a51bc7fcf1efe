#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "partition/formats/mesh_io.h"
#include "samples/command/smooth_command.h"
#include "samples/files/checkpoints.h"
#include "samples/files/output_files.h"
#include "samples/process/exit_status.h"
#include "samples/process/interruption.h"
#include "samples/report/progress_bar.h"

namespace seamflow {

/// The file for the last complete step if the run is interrupted: "smooth.ply" becomes "smooth.interrupted.ply", and so
/// on if that is the input.
std::filesystem::path interrupted_path(const std::filesystem::path& output, const std::filesystem::path& input);

/// Runs beside the flow of `smooth`: the progress bar, checkpoints, and the handling of interruptions.
class LongRun {
  public:
    /// Reserves room for the result, and loads the checkpoint, if there is one; from here on, a signal makes the flow
    /// stop.
    /// @param file its mesh flows; all arguments must outlive this.
    /// @throws what Checkpoints::find throws; OutputError if there is no room.
    LongRun(const SmoothCommand& command, const MeshFile& file, Interruption& interruption, std::ostream& out);

    /// The control for the flow. Its observer must not outlive this.
    [[nodiscard]] FlowControl control();

    /// An observer that calls `inner` and saves checkpoints.
    [[nodiscard]] StepObserver observing(StepObserver inner);

    /// After the flow: makes room for other text and for the result.
    void end();

    /// Wall-clock time that checkpoints have taken.
    [[nodiscard]] double checkpoint_seconds() const { return checkpoints_ ? checkpoints_->seconds() : 0.0; }

    /// After the flow was cancelled: writes the last complete step, if there was one, and reports it.
    /// @returns the exit status.
    /// @throws OutputError.
    [[nodiscard]] ExitStatus end_early();

    /// After the flow failed: writes the last complete step, if there was one and it can be written, and reports it.
    void keep_last_step();

  private:
    [[nodiscard]] std::filesystem::path write_last_step();

    const SmoothCommand* command_;
    const MeshFile* file_;
    Interruption* interruption_;
    ProgressBar bar_;
    ReservedRoom room_;
    std::optional<Checkpoints> checkpoints_;
    std::shared_ptr<const FlowState> resume_;
    /// The last complete step of this run; 0: none.
    int step_ = 0;
    /// With --keep-gaps, the separate sub-meshes at that step.
    std::optional<PolygonMesh> separated_;
};

}  // namespace seamflow
