#pragma once

#include <cstdint>
#include <span>

#include "engine/measure/run_report.h"
#include "engine/motion/similarity.h"
#include "engine/state/step_memory.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Moves a surface by steps, one after the other: each from positions Vᵏ to Vᵏ⁺¹. It runs on the threads of the arena
/// in which it is constructed.
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

    /// Continues from an image of positions(), and of all positions that the next step needs: after a step whose motion
    /// is restricted to lines, or whose result is rescaled (see MotionConstraints). Afterwards positions() are the
    /// image, up to rounding. What the stepper keeps of earlier steps besides positions, such as the update of the last
    /// one and its estimate of the error, is not rescaled: a step of a flow that shrinks the surface makes earlier
    /// errors smaller by about the factor by which rescaling enlarges the surface again.
    /// @param image #V by 3: positions() mapped by the similarity of each component, or moved otherwise if there is no
    /// similarity; vertices without faces keep their positions.
    virtual void set_positions(const Points& image, const SimilarityOfComponents& similarity) = 0;

    /// #F: 1 in components that the stepper bounds itself, and whose volumes it restores: limits that were
    /// not asked for do not apply to them. Empty: there are none.
    [[nodiscard]] virtual std::span<const std::uint8_t> bounded() const { return {}; }

    /// Saves the data that the next step needs.
    virtual void save(StepMemory& memory) const = 0;

    /// Restores the data that `save` has written, before any step: the next step continues from there.
    /// @throws InputError if the data do not fit.
    virtual void restore(const StepMemory& memory) = 0;
};

}  // namespace seamflow
