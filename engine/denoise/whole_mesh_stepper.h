#pragma once

#include "engine/denoise/denoise_report.h"
#include "engine/motion/surface_stepper.h"

namespace seamflow {

/// The base of the denoiser's steppers. Each step moves the vertices of the whole mesh, without sub-meshes and without
/// the equations of a flow. Threads share the faces and vertices; the bits do not depend on the number of threads.
class WholeMeshStepper : public SurfaceStepper {
  public:
    /// Fills in the data on all steps.
    virtual void report_to(DenoiseReport& report) const = 0;
};

}  // namespace seamflow
