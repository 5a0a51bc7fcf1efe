#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The flow of mean_curvature_flow, taken step by step, by programs that look at each result before they go on. Between
/// steps it keeps the cut, the analyses of sub-meshes, and what else the next step can use: a step of the linear flow
/// after the first is one solution with the factors of the first. After FlowOptions::steps steps the positions are
/// those of mean_curvature_flow, bit for bit. While a flow exists, the BLAS of the process runs single-threaded (see
/// Workers).
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

    /// Takes steps; the mesh moves with each.
    /// @param n at least 0.
    /// @throws as mean_curvature_flow; the positions are then those of the last complete step, and no further one can
    ///         be taken: ComputationError.
    void step(int n = 1);

    /// Changes between steps: the next one takes them up, and only the sub-meshes that have such vertices are made
    /// anew. A flow that was changed has no state to resume from. Vertices joined along seams change together. Besides
    /// what is said below, all throw OptionError for flows with a reference, rescale, within or limits, and, `move` of
    /// mean curvature flows aside, for those that take sweeps, conjugate gradients or UMFPACK's factors (begin a new
    /// Flow from the positions instead); InputError for vertices that do not exist; ComputationError after a failure.

    /// Holds vertices where they are.
    void hold(std::span<const Index> vertices);

    /// Lets vertices move again that were held since the flow began.
    /// @throws OptionError for vertices that were fixed before.
    void release(std::span<const Index> vertices);

    /// Puts vertices elsewhere, fixed ones, too. What linear and conformalized flows keep of V⁰ is then as if the flow
    /// had begun with them there.
    /// @param to #vertices by 3.
    /// @throws InputError where one would have an edge without length or a face without area.
    void move(std::span<const Index> vertices, const Points& to);

    /// Changes the weights of an attachment.
    /// @param weights one for each vertex: w, in 1/length², at least 0.
    /// @throws OptionError for flows without an attachment.
    void attach(std::span<const Index> vertices, std::span<const double> weights);

    /// Applies steps to data on the surface in place of its positions, which stay: n backward Euler steps of the heat
    /// equation, (M + dt K) Xᵏ⁺¹ = M Xᵏ, with the factorisation of the first step. See also diffuse, which is easier.
    /// @param fields #V by any number of columns, finite. Vertices that are held keep their values. Those that are
    ///        joined along seams begin with their mean.
    /// @throws OptionError for flows that are not linear; InputError for another number of rows, or numbers that are
    ///         not finite; as step.
    void diffuse(Eigen::Ref<Eigen::MatrixXd> fields, int n = 1);

    /// Lets further steps of `diffuse` keep edges of fields: K of each face (Δ_F and Δ_U: each edge) counts
    /// 1 / (1 + (d / difference)²), where d is the largest distance between the rows of two of its vertices (Perona and
    /// Malik, Scale-Space and Edge Detection Using Anisotropic Diffusion, 1990). K is factorised anew.
    /// @param fields #V by any number of columns, finite. @param difference positive.
    /// @throws OptionError for conjugate gradients, and as diffuse.
    void keep_field_edges(const Eigen::Ref<const Eigen::MatrixXd>& fields, double difference);

    /// How many steps were taken, those before the state to resume from included.
    [[nodiscard]] int n_steps() const { return static_cast<int>(report_.steps.size()); }

    /// On all steps so far. After a failure its ConvergenceReport may count the step that failed.
    [[nodiscard]] FlowReport report() const;

  private:
    friend FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                                          const FlowControl& control);
    class Session;

    void require_fields(const Eigen::Ref<const Eigen::MatrixXd>& fields) const;

    bool is_linear_;
    StepObserver on_step_;
    FlowControl control_;
    FlowReport report_;
    std::unique_ptr<Session> session_;
};

}  // namespace seamflow
