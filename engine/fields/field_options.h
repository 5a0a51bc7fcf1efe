#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"

namespace seamflow {

class LengthScale;

/// AccuracyOptions::tolerance of fields if it is not set.
inline constexpr double default_field_tolerance = 1e-8;

/// The weights of the edges of a surface, -K_vw.
enum class Weights {
    /// The weights of the Laplacian. Cotangents of obtuse angles are below 0.
    OfLaplacian,
    /// At least 0, so that no step of Filter::Diffusion of order 1 leaves the range of its data (the discrete maximum
    /// principle). Where the Laplacian has others, K and M are those of an intrinsic Delaunay triangulation of the
    /// surface (see make_delaunay). For Δ_A (AlexaWardetzky) and Δ_B (VirtualRefinement); other Laplacians have no such
    /// weights.
    AtLeastZero,
    /// At least 0 also in the K of each single face: for HeatEquation::keep_field_edges, which weighs faces
    /// differently.
    AtLeastZeroInFaces,
};

/// The options that only fields have.
struct FieldOptions {
    /// The amount of all steps together, in place of FlowOptions::time_step and radius: the full width at half maximum
    /// that white noise has after them (see time_for_fwhm). What is reached on the mesh is measured (see
    /// FieldReport::fwhm): a few hundredths less, and much less after one step, with other filters, and on surfaces
    /// that are only a few widths wide.
    std::optional<LengthOnMesh> fwhm = {};
    /// Keeps edges of the fields: differences well above this diffuse little (see HeatEquation::keep_field_edges). All
    /// columns count together, as one vector per vertex. K is factorised in each step. Not with conjugate gradients.
    std::optional<double> keep_edges = {};
    /// Gives vertices without data, after all steps, the harmonic extension of the data: K X = 0 there.
    bool fill = false;
    /// Used in place of FlowOptions::laplacian; must be symmetric. M⁻¹ K of AlexaWardetzky and VirtualRefinement is the
    /// Laplace-Beltrami operator on any faces, so that times and widths of kernels are exact. M⁻¹ K of Fujiwara and
    /// Uniform depends on the faces: on regular triangles Fujiwara's smooths √1.5 times as wide.
    Laplacian laplacian = Laplacian::VirtualRefinement;
    /// AtLeastZero, which is AtLeastZeroInFaces with keep_edges, or the weights of the Laplacian, with which values can
    /// leave their range beside obtuse angles. Ranks do not share steps with weights other than the Laplacian's.
    Weights weights = Weights::AtLeastZero;
    /// Free: no heat flows across the boundary. Fixed: values at the boundary do not change, bit for bit.
    Boundary boundary = Boundary::Free;
    /// The names of the columns, for remarks; empty: columns are called by their numbers, from 0.
    std::vector<std::string> names = {};
};

/// The time, in length², of m backward Euler steps together after which white noise is as smooth as after a Gaussian
/// kernel with this full width at half maximum, in length. After the time t the heat equation has
/// t = FWHM² / (16 ln 2). The power spectrum of m steps, (1 + tk² / m)⁻²ᵐ at the wave number k, has the second moment
/// that the heat equation has after (m - 1) / m of the time, which is made up for. That of one step has none; it and
/// other filters than diffusion of order 1 get the time of the heat equation.
/// @param options their steps and filter count.
double time_for_fwhm(double fwhm, const FlowOptions& options);

/// The full width at half maximum, in length, that white noise has after a time in length²: inverse of time_for_fwhm.
double fwhm_for_time(double time, const FlowOptions& options);

/// Options with the width in length.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by.
FieldOptions resolved(FieldOptions options, LengthScale& scale);

/// @throws OptionError for options that fields do not have.
void require_for_fields(const FlowOptions& options, const FieldOptions& of_fields);

/// The options of the linear flow that is applied to fields, with the time step that follows from FieldOptions::fwhm.
/// @param of_fields with a width in length.
FlowOptions flow_for_fields(const FlowOptions& options, const FieldOptions& of_fields);

/// The weights of edges with which fields diffuse.
Weights weights_for_fields(const FieldOptions& of_fields);

}  // namespace seamflow
