#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/cost_model.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/remark.h"

namespace seamflow {

/// How steps are taken, and in which sub-meshes.
struct DecidedSteps {
    /// The input of the costs of steps; empty if the way of taking steps was not chosen by cost.
    std::optional<FlowSize> costs;
    /// The approach that replaces steps whose factors do not fit into the memory limit; empty: none.
    std::optional<ApproachChoice> without_factors;
    /// Replaces `choices` if `without_factors` is used.
    std::vector<Remark> choices_without_factors;
    /// The sub-mesh of every face.
    Cut cut;
    /// What was done with the faces, and the reasons for the choice of sub-meshes and steps.
    std::vector<Remark> choices;
    /// Remarks on the mesh and the cut.
    std::vector<Remark> remarks;
};

/// The fraction of a whole call that is done before its first step: about as long as this takes some steps.
/// @param options as given. @param n_taken the number of steps that are not taken again.
double fraction_of_setup(const FlowOptions& options, int n_taken = 0);

/// Decides how steps are taken: whether they are converged, and in which sub-meshes.
/// @param options gets the approach and the tolerance.
/// @param earlier the approach of the steps that are continued, which is kept; empty: these are the first.
/// @param measure called once, at the same time as METIS if there are threads for both.
/// @throws InputError for labels that cannot be used; ComputationError for a failure of METIS; Cancelled.
DecidedSteps decide_steps(const PolygonMesh& mesh, const Surface& surface, FlowOptions& options,
                          std::optional<Approach> earlier, Sharing sharing, Progress& progress,
                          const std::function<void()>& measure);

/// Changes the steps to conjugate gradients, as DecidedSteps::without_factors says: no sub-meshes, no factorisations.
/// @param options gets the approach and the tolerance.
void leave_factors(DecidedSteps& steps, FlowOptions& options, const PolygonMesh& mesh, const Topology& topology,
                   const Executor& exec);

/// Adds the decisions, and the counts of vertices, to the report.
/// @param need_of_junctions the result of the function of this name in automatic_choices.h.
void report_to(const DecidedSteps& steps, const Surface& surface, const FlowOptions& options, const FlowingMesh& mesh,
               std::string_view need_of_junctions, FlowReport& report);

}  // namespace seamflow
