#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"

namespace seamflow {

/// AccuracyOptions::tolerance of fields where it is left open.
inline constexpr double default_field_tolerance = 1e-8;

/// What concerns fields alone.
struct FieldOptions {
    /// The amount of all steps together, in place of FlowOptions::time_step and radius: the full width at half maximum
    /// of the Gaussian kernel of the heat equation at the time t = FWHM² / (16 ln 2) of all steps, in length. Backward
    /// Euler steps come near to it if there are several (see FieldReport::fwhm).
    std::optional<double> fwhm = {};
    /// Keeps edges of the fields: differences well above this diffuse little (see Flow::keep_field_edges). All columns
    /// count together, as one vector per vertex. K is factorised in each step. Not with conjugate gradients.
    std::optional<double> keep_edges = {};
    /// Gives vertices without data, after all steps, the harmonic extension of the others: K X = 0 there.
    bool fill = false;
    /// In place of FlowOptions::laplacian: a symmetric one. M⁻¹ K of Δ_A and Δ_B is the Laplace-Beltrami operator on
    /// any faces, so that time and width of a kernel mean what they say. Those of Δ_F and Δ_U depend on the faces: on
    /// regular triangles Δ_F smooths √1.5 times as wide.
    Laplacian laplacian = Laplacian::VirtualRefinement;
    /// In place of FlowOptions::weights: AtLeastZero, also in faces with keep_edges, or those of the Laplacian, with
    /// which values may leave their range beside obtuse angles.
    Weights weights = Weights::AtLeastZero;
    /// Free: no heat flows across the boundary. Fixed: values there stay, bit for bit.
    Boundary boundary = Boundary::Free;
    /// Of the columns, for remarks; empty: they are called by their numbers, from 0.
    std::vector<std::string> names = {};
};

/// The time of a kernel of that width, FWHM² / (16 ln 2), in length².
double time_for_fwhm(double fwhm);

/// Its inverse: the full width at half maximum, in length, after a time in length².
double fwhm_for_time(double time);

/// @throws OptionError for options that fields do not have.
void require_for_fields(const FlowOptions& options, const FieldOptions& of_fields);

/// The options of the flow that is applied to fields. A time step that follows from FieldOptions::fwhm is set.
FlowOptions flow_for_fields(const FlowOptions& options, const FieldOptions& of_fields);

}  // namespace seamflow
