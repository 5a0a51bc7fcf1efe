#pragma once

#include <optional>

#include "engine/motion/component_limits.h"
#include "engine/motion/directed_motion.h"
#include "engine/motion/displacement_bound.h"
#include "engine/motion/rescaling.h"
#include "engine/motion/surface_stepper.h"
#include "engine/motion/update_limit.h"
#include "engine/options/motion_options.h"
#include "engine/tasks/parallel_executor.h"

namespace seamflow {

/// The objects that change the positions of a step, whatever takes it: the constraints that it obeys, and the maps from
/// its positions to a result.
struct MotionConstraints {
    /// @param motion resolved (see resolved_motion.h). @param continues_scaled whether steps begin with rescaled
    /// results, if results are rescaled. @param largest_update of a vertex in a step, in diagonals of the box around
    /// the faces (see UpdateLimit).
    MotionConstraints(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion,
                      bool continues_scaled, double largest_update)
        : is_scaled(motion.rescale != Rescale::None && continues_scaled)
        , is_scaled_apart(motion.rescale != Rescale::None && !is_scaled)
        , rescaling(mesh, topology, motion.rescale)
        , mesh_(&mesh)
    {
        if (motion.direction.kind != MotionDirection::Kind::Any)
            directed_.emplace(mesh, topology, motion.direction);
        limit.emplace(mesh, largest_update);
        if (motion.limits.exist())
            limited.emplace(mesh, topology, motion.limits);
        has_default_limits_ = motion.limits == ComponentLimits{.volume = ComponentLimits::most_volume_change};
        if (motion.within)
            bound.emplace(mesh, topology, bound_along(motion.direction, *motion.within));
    }

    /// Whether results differ from the positions from which the flow continues.
    [[nodiscard]] bool has_results_apart() const { return is_scaled_apart || bound || limited; }

    /// Turns positions of the flow into a result. @param stepper that made them.
    void make_result(const SurfaceStepper& stepper, Points& positions)
    {
        if (is_scaled_apart)
            rescaling.apply(positions);
        if (bound)
            bound->apply(positions);
        if (limited)
            limited->apply(positions, has_default_limits_ ? stepper.bounded() : std::span<const std::uint8_t>());
        if (directed_ && directed_->is_parallel() && has_results_apart())
            directed_->straighten(mesh_->vertices, positions, run_in_parallel);
    }

    /// Reduces the motion of a step to the lines that the options ask for.
    /// @param before #V by 3: the positions at the beginning of the step.
    void direct(SurfaceStepper& stepper, const Points& before) const
    {
        if (!directed_)
            return;
        Points directed = stepper.positions();
        directed_->project(before, directed, run_in_parallel);
        stepper.set_positions(directed, {});
    }

    /// Rescales the positions with which the next step begins, if steps begin with results.
    void rescale(SurfaceStepper& stepper)
    {
        if (!is_scaled)
            return;
        Points rescaled = stepper.positions();
        const SimilarityOfComponents similarity = rescaling.apply(rescaled);
        stepper.set_positions(rescaled, similarity);
    }

    /// Whether a step begins with the rescaled result of the previous step, and not with its unscaled positions. The
    /// weights of the conformalized flow do not depend on the size of the surface: it becomes a sphere instead of
    /// vanishing.
    bool is_scaled;
    /// Whether results are rescaled, and steps begin with the unscaled positions.
    bool is_scaled_apart;
    Rescaling rescaling;
    std::optional<LimitedComponents> limited;
    std::optional<DisplacementBound> bound;
    std::optional<UpdateLimit> limit;

  private:
    const PolygonMesh* mesh_;
    std::optional<DirectedMotion> directed_;
    /// Whether limits are those where a run chooses how much to smooth.
    bool has_default_limits_ = false;
};

}  // namespace seamflow
