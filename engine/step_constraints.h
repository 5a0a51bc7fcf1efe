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

/// The tools that take and check steps, and make results from their positions.
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

    /// Whether results differ from the positions that the flow continues from.
    [[nodiscard]] bool has_results_apart() const { return is_scaled_apart || bound || limited; }

    /// Makes a result of positions of the flow.
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

    /// Leaves of a step only the motion along the lines that the options ask for.
    /// @param before #V by 3: where the step began.
    void direct(Stepper& stepper, const Points& before) const
    {
        if (!directed_)
            return;
        Points directed = stepper.positions();
        directed_->project(before, directed, run_in_parallel);
        stepper.set_positions(directed, {});
    }

    /// Rescales the surface that the next step begins with, where steps begin with results.
    void rescale(Stepper& stepper)
    {
        if (!is_scaled)
            return;
        Points rescaled = stepper.positions();
        const SimilarityOfComponents similarity = rescaling.apply(rescaled);
        stepper.set_positions(rescaled, similarity);
    }

    /// On components that lose too much; limits have their own. And on those that cannot be scaled back.
    [[nodiscard]] std::vector<Remark> remarks() const
    {
        std::vector<Remark> all;
        for (const auto& remark : {limited ? limited->remark() : vanishing.remark(), rescaling.remark()})
            if (remark)
                all.push_back(*remark);
        return all;
    }

    /// Whether a step begins with the rescaled result of the previous one, not with that itself. The weights of the
    /// conformalized flow do not depend on the size of the surface: it becomes a sphere instead of vanishing.
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
