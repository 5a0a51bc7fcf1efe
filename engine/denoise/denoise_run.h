#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/denoise/denoise_options.h"
#include "engine/denoise/denoise_report.h"
#include "engine/denoise/whole_mesh_stepper.h"
#include "engine/motion/surface_run.h"
#include "engine/options/flow_control.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"

namespace seamflow {

/// Takes the steps of denoise().
class DenoiseRun final : public SurfaceRun {
  public:
    /// @param surface, progress, report must outlive the run. @param options valid; their motion is that of the
    /// surface. @param identity the checksum for states (see identify); 0 if nobody asks for a state. @param setup the
    /// fraction of the whole call that setup takes.
    /// @throws InputError for a state that does not fit.
    DenoiseRun(Surface& surface, const DenoiseOptions& options, std::uint64_t identity, double setup,
               Progress& progress, DenoiseReport& report, const FlowControl& control);

    /// Completes the report on the run as a whole.
    void complete(DenoiseReport& report) const;

  protected:
    [[nodiscard]] SurfaceStepper& stepper() const override { return *stepper_; }
    [[nodiscard]] FlowState capture() const override;

  private:
    std::unique_ptr<WholeMeshStepper> stepper_;
    std::uint64_t identity_;
};

}  // namespace seamflow
