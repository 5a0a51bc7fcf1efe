#pragma once

#include <optional>
#include <vector>

#include "engine/measure/component_limits.h"
#include "engine/measure/displacement_bound.h"
#include "engine/measure/rescaling.h"
#include "engine/measure/update_limit.h"
#include "engine/steppers/directed_motion.h"
#include "engine/steppers/vanishing_components.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/remark.h"

namespace seamflow {

/// The objects that change the positions of a step: the constraints that it obeys, and the maps from its positions to a
/// result.
struct StepConstraints {
    StepConstraints(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options)
        : is_scaled(options.motion.rescale != Rescale::None && options.flow == FlowEquation::Conformalized)
        , is_scaled_apart(options.motion.rescale != Rescale::None && !is_scaled)
        , rescaling(mesh, topology, options.motion.rescale)
        , vanishing(mesh, topology, options)
        , mesh_(&mesh)
    {
        if (options.motion.direction.kind != MotionDirection::Kind::Any)
            directed_.emplace(mesh, topology, options.motion.direction);
        limit.emplace(mesh, options.accuracy.largest_update);
        if (options.motion.limits.exist())
            limited.emplace(mesh, topology, options.motion.limits);
        if (options.motion.within)
            bound.emplace(mesh, topology, *options.motion.within);
    }

    /// Whether results differ from the positions from which the flow continues.
    [[nodiscard]] bool has_results_apart() const { return is_scaled_apart || bound || limited; }

    /// Turns positions of the flow into a result.
    void make_result(Points& positions)
    {
        if (is_scaled_apart)
            rescaling.apply(positions);
        if (bound)
            bound->apply(positions);
        if (limited)
            limited->apply(positions);
        if (directed_ && directed_->is_parallel() && has_results_apart())
            directed_->straighten(mesh_->vertices, positions, run_in_parallel);
    }

    /// Reduces the motion of a step to the lines that the options ask for.
    /// @param before #V by 3: the positions at the beginning of the step.
    void direct(Stepper& stepper, const Points& before) const
    {
        if (!directed_)
            return;
        Points directed = stepper.positions();
        directed_->project(before, directed, run_in_parallel);
        stepper.set_positions(directed, {});
    }

    /// Rescales the positions with which the next step begins, if steps begin with results.
    void rescale(Stepper& stepper)
    {
        if (!is_scaled)
            return;
        Points rescaled = stepper.positions();
        const SimilarityOfComponents similarity = rescaling.apply(rescaled);
        stepper.set_positions(rescaled, similarity);
    }

    /// Remarks on components that lose too much, and on components that cannot be scaled back.
    [[nodiscard]] std::vector<Remark> remarks() const
    {
        std::vector<Remark> all;
        for (const auto& remark : {limited ? limited->remark() : vanishing.remark(), rescaling.remark()})
            if (remark)
                all.push_back(*remark);
        return all;
    }

    /// Whether a step begins with the rescaled result of the previous step, and not with its unscaled positions. The
    /// weights of the conformalized flow do not depend on the size of the surface: it becomes a sphere instead of
    /// vanishing.
    bool is_scaled;
    bool is_scaled_apart;
    Rescaling rescaling;
    std::optional<LimitedComponents> limited;
    std::optional<DisplacementBound> bound;

    VanishingComponents vanishing;
    std::optional<UpdateLimit> limit;

  private:
    const PolygonMesh* mesh_;
    std::optional<DirectedMotion> directed_;
};

}  // namespace seamflow
