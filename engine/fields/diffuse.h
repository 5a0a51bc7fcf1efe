#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "engine/fields/field_options.h"
#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

/// What diffuse did.
struct FieldReport {
    /// Of the flow; its steps count all columns. Columns whose data are at different vertices have flows of their own:
    /// its remarks and choices are those of all these, once each; a remark on some columns names them. Those on filling
    /// say so.
    FlowReport flow;
    /// With FieldOptions::fwhm: the width that was reached, in length, as white noise at the vertices shows that has
    /// diffused in the same way: from the variances of values and of their differences along edges (Forman and others,
    /// Improved Assessment of Significant Activation in Functional Magnetic Resonance Imaging, 1995).
    std::optional<double> fwhm = {};
    /// How many vertices have no data in one column at least; and to how many of them the extension has given some.
    Index without_data = 0;
    Index filled = 0;
    /// For the user: those of the flow.
    std::vector<Remark> remarks;
};

/// Lets fields on a surface diffuse by its heat equation, (M + dt K) Xᵏ⁺¹ = M Xᵏ in each step; the surface stays. The
/// matrix is factorised once for all steps and columns, but for FieldOptions::keep_edges. The integral Σ M X of each
/// column stays, with a free boundary and without fixed vertices. With a plain filter no value leaves the range that
/// its column has at first: weights of K are at least 0 (see FieldOptions::weights; those of Δ_F and Δ_U always are).
/// @param fields #V by n: values at the vertices; NaN is no data. Vertices without data take no part: the surface of a
///        column is that of the faces whose vertices all have data, but for faces without area. Vertices that are
///        fixed, have no such face, or no row in the Laplacian, keep their values; those joined along seams get one
///        value.
/// @param options of the flow: amount, steps, sub-meshes, threads. AccuracyOptions::tolerance is 1e-8 where it is left
///        open. MotionOptions::boundary does not count; a Laplacian that is chosen here is that of field_options, too.
/// @throws InputError for a mesh or fields that cannot be used: another number of rows, infinite values; OptionError
///         for options that fields do not have: sweeps, explicit steps, an attachment, limits, rescaling; as
///         mean_curvature_flow. The fields are then unchanged.
FieldReport diffuse(const PolygonMesh& mesh, Eigen::MatrixXd& fields, const FlowOptions& options,
                    const FieldOptions& field_options = {}, const FlowControl& control = {});

}  // namespace seamflow
