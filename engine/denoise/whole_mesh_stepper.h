#pragma once

#include "engine/denoise/denoise_report.h"
#include "engine/motion/surface_stepper.h"

namespace seamflow {

/// Takes steps of a whole mesh, without sub-meshes and without the equations of a flow. Its faces and vertices are
/// shared among the threads; the bits do not depend on their number.
class WholeMeshStepper : public SurfaceStepper {
  public:
    /// Fills in the data on all steps.
    virtual void report_to(DenoiseReport& report) const = 0;
};

}  // namespace seamflow
