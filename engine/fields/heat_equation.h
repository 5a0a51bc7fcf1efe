#pragma once

#include <memory>

#include <Eigen/Core>

#include "engine/fields/field_options.h"
#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The heat equation on a surface that does not move. Each step is a backward Euler step (M + dt K) Xᵏ⁺¹ = M Xᵏ for any
/// number of columns X. All steps have the same matrix, which is factorised in the first one. The function diffuse is
/// easier to use. While an equation exists, the BLAS of the process runs single-threaded (see Workers).
class HeatEquation {
  public:
    /// Checks the surface and sets up.
    /// @param surface with any polygons. Vertices along seams are joined; faces that repeat others are left out.
    /// @param options of a linear flow. Steps are converged, undecomposed, or by conjugate gradients. The solver is
    ///        chosen for FlowOptions::steps steps of three columns; other numbers may be taken. Options on the motion
    ///        of vertices, and on measurements, are not used.
    /// @param weights the weights of edges. Processes do not share steps with weights other than the Laplacian's.
    /// @param control reports progress, stops the steps, and may have ranks that share them.
    /// @throws InputError for a surface or labels that cannot be used; OptionError for options of a flow that is not
    ///         linear, or outside their limits, and for a state to resume from; ComputationError naming the sub-mesh;
    ///         Cancelled; std::bad_alloc.
    HeatEquation(PolygonMesh surface, const FlowOptions& options, Weights weights = Weights::OfLaplacian,
                 FlowControl control = {});
    HeatEquation(const HeatEquation&) = delete;
    HeatEquation& operator=(const HeatEquation&) = delete;
    ~HeatEquation();

    /// The surface as it was given.
    [[nodiscard]] const PolygonMesh& surface() const { return surface_; }

    /// Takes n steps.
    /// @param fields #V by any number of columns, finite; receives the result. Fixed vertices keep their values.
    ///        Vertices joined along seams begin with their mean.
    /// @throws InputError for another number of rows, or numbers that are not finite; ComputationError naming step and
    ///         sub-mesh, and in all calls after a failure; Cancelled.
    void take_steps(Eigen::Ref<Eigen::MatrixXd> fields, int n = 1);

    /// Makes further steps keep edges of fields: K of each face (of each edge for Fujiwara and Uniform) is multiplied
    /// by 1 / (1 + (d / difference)²), where d is the largest distance between the rows of two of its vertices (Perona
    /// and Malik, Scale-Space and Edge Detection Using Anisotropic Diffusion, 1990). K is factorised anew.
    /// @param fields #V by any number of columns, finite. @param difference positive, in the unit of the fields.
    /// @throws OptionError for a difference that is not above 0, for conjugate gradients, and for ranks that share the
    ///         steps; InputError as take_steps.
    void keep_field_edges(const Eigen::Ref<const Eigen::MatrixXd>& fields, double difference);

    /// The report on all steps so far. Steps of different columns count once.
    [[nodiscard]] FlowReport report() const;

  private:
    class Session;

    void require_fields(const Eigen::Ref<const Eigen::MatrixXd>& fields) const;

    PolygonMesh surface_;
    FlowControl control_;
    FlowReport report_;
    std::unique_ptr<Session> session_;
};

}  // namespace seamflow
