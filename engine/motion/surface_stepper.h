#pragma once

#include <span>

#include "engine/measure/run_report.h"
#include "engine/motion/similarity.h"
#include "engine/state/step_memory.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Moves a surface by steps, one after the other: each from Vᵏ to Vᵏ⁺¹. Belongs to the arena in which it is
/// constructed.
class SurfaceStepper {
  public:
    SurfaceStepper() = default;
    SurfaceStepper(const SurfaceStepper&) = delete;
    SurfaceStepper& operator=(const SurfaceStepper&) = delete;
    virtual ~SurfaceStepper() = default;

    /// Takes a step. After an exception there are no positions, and the stepper is unusable.
    /// @param before #V by 3: Vᵏ, which is or was equal to positions(), in separate memory.
    /// @throws ComputationError naming the sub-mesh; Cancelled.
    virtual void step(const Points& before) = 0;

    /// #V by 3: the positions after the last step.
    [[nodiscard]] virtual const Points& positions() const = 0;

    /// Continues from an image of positions(), and of all positions that the next step needs. Afterwards positions()
    /// are the image, up to rounding. Data on updates and errors are kept: a step makes earlier errors smaller by about
    /// the factor by which its result is scaled back.
    /// @param image #V by 3: positions() mapped by the similarity of each component; vertices without faces keep their
    /// positions.
    virtual void set_positions(const Points& image, const SimilarityOfComponents& similarity) = 0;

    /// Saves the data that the next step needs.
    virtual void save(StepMemory& memory) const = 0;

    /// Restores the data that `save` has written, before any step: the next step continues from there.
    /// @throws InputError if the data do not fit.
    virtual void restore(const StepMemory& memory) = 0;
};

}  // namespace seamflow
