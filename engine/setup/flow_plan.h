#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/step_settings.h"
#include "engine/setup/way_of_steps.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/remark.h"

namespace seamflow {

/// How the steps of a flow are taken: decided once, from its options and its surface.
struct FlowPlan {
    WayOfSteps way;
    /// The sub-mesh of every face; a single one if the way has none.
    Cut cut;
    /// What was done with the faces, and the reasons for the choice of sub-meshes and steps.
    std::vector<Remark> choices;
    /// Remarks on the mesh and the cut.
    std::vector<Remark> remarks;

    /// Another way, and the choices that belong to it.
    struct Alternative {
        GradientSteps way;
        std::vector<Remark> choices;
    };
    /// The way that replaces `way` if its factors do not fit into the memory limit; empty: there is none.
    std::optional<Alternative> without_factors;
};

/// The fraction of a whole call that is done before its first step: setting up takes about as long as 3 to 6 steps,
/// depending on how steps are taken.
/// @param options as given. @param n_taken the number of steps of an earlier call, which are not taken again.
double fraction_of_setup(const FlowOptions& options, int n_taken = 0);

/// Where setting up begins to make steppers, once the plan is decided, as a fraction of the set-up (an estimate).
inline constexpr double begin_of_steppers = 0.6;

/// Decides how steps are taken, and in which sub-meshes.
/// @param options resolved; with labels of the faces of the mesh that moves.
/// @param earlier the approach of the steps that are continued, which is kept; empty: these are the first.
/// @param measure called once with the approach, at the same time as METIS if there are threads for both.
/// @throws InputError for labels that cannot be used; ComputationError for a failure of METIS; Cancelled.
FlowPlan decide(const Surface& surface, const FlowOptions& options, std::optional<Approach> earlier, Sharing sharing,
                Progress& progress, const std::function<void(Approach)>& measure);

/// Replaces the plan's way by `without_factors`, which must exist, and the cut by the whole mesh. To be called once.
void leave_factors(FlowPlan& plan, const PolygonMesh& mesh, const Topology& topology, const Executor& exec);

/// The sweep that the options ask for, if there are this many sub-meshes.
/// @param options resolved.
SweepSteps sweeps_of(const FlowOptions& options, Index n_sub_meshes);

/// The settings for steps that are taken in this way.
/// @param options resolved. @param initial #V by 3: V⁰. Both must outlive the result.
StepSettings settings_of(const FlowOptions& options, const WayOfSteps& way, const Points& initial);

/// Adds the decisions, and the counts of vertices, to the report.
/// @param need_of_junctions the result of the function of this name in automatic_choices.h.
void report_to(const FlowPlan& plan, const Surface& surface, const FlowOptions& options,
               std::string_view need_of_junctions, FlowReport& report);

}  // namespace seamflow
