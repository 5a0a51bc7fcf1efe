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

/// The report of diffuse.
struct FieldReport {
    /// The report of the flow. Its steps count for all columns. Columns with data at different vertices have flows of
    /// their own: the remarks and choices are those of all flows, each once. A remark on some columns names them, and a
    /// remark on filling says so.
    FlowReport flow;
    /// With FieldOptions::fwhm: the width that was reached, in length. It is measured on white noise that diffused in
    /// the same way, from the variances of values and of their differences along edges (Forman and others, Improved
    /// Assessment of Significant Activation in Functional Magnetic Resonance Imaging, 1995).
    std::optional<double> fwhm = {};
    /// The number of vertices that have no data in at least one column; and the number of these that the extension has
    /// given data.
    Index without_data = 0;
    Index filled = 0;
    /// Remarks for the user: the same as in `flow`.
    std::vector<Remark> remarks;
};

/// Lets fields on a surface diffuse by its heat equation, (M + dt K) Xᵏ⁺¹ = M Xᵏ in each step; the surface does not
/// move. The matrix is factorised once for all steps and columns, except with FieldOptions::keep_edges. The integral Σ
/// M X of each column is constant, with a free boundary and without fixed vertices. With a plain filter no value leaves
/// the range that its column has before the first step: weights of K are at least 0 (see FieldOptions::weights; the
/// weights of Δ_F and Δ_U, Fujiwara and Uniform, always are).
/// @param fields #V by n: values at the vertices; NaN is no data. Vertices without data take no part: the surface of a
///        column consists of the faces whose vertices all have data, without faces that have no area. Vertices that are
///        fixed, have no such face, or no row in the Laplacian, keep their values; vertices joined along seams get one
///        value.
/// @param options of the flow: amount, steps, sub-meshes, threads. AccuracyOptions::tolerance is 1e-8 if it is not set.
///        MotionOptions::boundary is ignored; a Laplacian that is set here must be that of field_options.
/// @throws InputError for a mesh or fields that cannot be used: another number of rows, infinite values; OptionError
///         for options that fields do not have: sweeps, explicit steps, an attachment, limits, rescaling; as
///         mean_curvature_flow. The fields are then unchanged.
FieldReport diffuse(const PolygonMesh& mesh, Eigen::MatrixXd& fields, const FlowOptions& options,
                    const FieldOptions& field_options = {}, const FlowControl& control = {});

}  // namespace seamflow
