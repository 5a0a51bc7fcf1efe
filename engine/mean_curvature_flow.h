#pragma once

#include <memory>
#include <span>
#include <stop_token>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Smooths a mesh by mean curvature flow: `options.steps` backward Euler steps (paper, eq. 3)
///
/// \f[ (I + dt\, \Delta(V^n))\, V^{n+1} = V^n , \f]
///
/// decomposed into sub-meshes, or explicit steps (see Scheme). Vertices without faces and, unless
/// MotionOptions::boundary is free, boundary vertices do not move, bit for bit.
/// @param mesh its positions are moved; after an exception they are those of the last complete step. The running flow
///        owns the mesh.
/// @param on_step called after each step.
/// @param control reports progress, stops the flow, or resumes it from an earlier step: `mesh` is then as it was before
///        the first step, and the report covers all steps.
/// @throws InputError for a mesh or labels that cannot be used, OptionError for options outside their limits, both for
///         a state to resume from that belongs to another flow; ComputationError, naming step and sub-mesh, for a
///         system that is singular, a result that is not finite or beyond AccuracyOptions::largest_update, and for a
///         failure of METIS; Cancelled if control.stop was requested and work was left; std::bad_alloc.
FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step = {},
                               const FlowControl& control = {});

/// The flow of mean_curvature_flow, taken step by step by programs that look at each result before they continue.
/// Between steps it keeps the cut, the analyses of sub-meshes, and all data that the next step can use: a step of the
/// linear flow after the first is one solution with the factors of the first. After FlowOptions::steps steps the
/// positions are those of mean_curvature_flow, bit for bit. While a flow exists, the BLAS of the process runs
/// single-threaded (see Workers).
class Flow {
  public:
    /// Checks the mesh and sets up.
    /// @param mesh must outlive the flow, which alone may move it.
    /// @param options the solver is chosen for FlowOptions::steps steps; more or fewer may be taken.
    /// @param on_step, control see mean_curvature_flow.
    /// @throws as mean_curvature_flow.
    Flow(PolygonMesh& mesh, const FlowOptions& options, StepObserver on_step = {}, FlowControl control = {});
    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;
    ~Flow();

    /// Takes n steps; the mesh moves with each.
    /// @param n at least 0. @param stop ends the call, if a stop is requested, after the step that is being taken: then
    /// nothing has failed, and the flow can go on with all that it has kept.
    /// @returns the number of steps that were taken.
    /// @throws as mean_curvature_flow, also where FlowControl::stop requests a stop; the positions are then those of
    ///         the last complete step, and any further call throws ComputationError.
    int step(int n = 1, const std::stop_token& stop = {});

    /// The following functions change the flow between steps. The next step uses the change; only the sub-meshes that
    /// have the changed vertices are made anew. A changed flow has no state to resume from. Vertices joined along seams
    /// change together. All functions throw OptionError for flows with a reference, rescale, within or limits, and,
    /// except `move` of mean curvature flows, for flows that take sweeps, conjugate gradients or UMFPACK's factors
    /// (begin a new Flow from the positions instead); InputError for vertices that do not exist; ComputationError after
    /// a failure.

    /// Fixes vertices at their positions.
    void hold(std::span<const Index> vertices);

    /// Lets vertices move again that were fixed since the flow began.
    /// @throws OptionError for vertices that were fixed when the flow began.
    void release(std::span<const Index> vertices);

    /// Moves vertices to given positions, also fixed vertices. V⁰ of linear and conformalized flows changes as if the
    /// flow had begun with the vertices there.
    /// @param to #vertices by 3.
    /// @throws InputError if a vertex would get an edge without length or a face without area.
    void move(std::span<const Index> vertices, const Points& to);

    /// Changes the weights of an attachment.
    /// @param weights one for each vertex: w, in 1/length², at least 0.
    /// @throws OptionError for flows without an attachment.
    void attach(std::span<const Index> vertices, std::span<const double> weights);

    /// The number of steps taken, including the steps before the state that the flow was resumed from.
    [[nodiscard]] int n_steps() const { return static_cast<int>(report_.steps.size()); }

    /// The report on all steps so far. After a failure, its ConvergenceReport may count the failed step.
    [[nodiscard]] FlowReport report() const;

  private:
    friend FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                                          const FlowControl& control);
    class Session;

    FlowReport take_report();

    StepObserver on_step_;
    FlowControl control_;
    FlowReport report_;
    std::unique_ptr<Session> session_;
};

}  // namespace seamflow
