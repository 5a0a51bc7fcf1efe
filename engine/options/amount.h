#pragma once

#include <optional>

namespace seamflow {

/// A length in units of the mesh, `0.5`; or a fraction of the diagonal of the box around its faces: `{0.01, true}` is
/// 1 % of it.
struct LengthOnMesh {
    constexpr LengthOnMesh(double in_units_or_diagonals = 0.0, bool is_of_diagonal = false)
        : value(in_units_or_diagonals)
        , of_diagonal(is_of_diagonal)
    {
    }

    double value;
    bool of_diagonal;

    friend bool operator==(const LengthOnMesh&, const LengthOnMesh&) = default;
};

/// How much is smoothed, in one of three ways.
struct SmoothingAmount {
    /// dt of one step, in length²; one step smooths over a distance of about √dt. Must be positive and finite, or 0 if
    /// another field gives the amount.
    double time_step = 0.0;
    /// dt of one step, in squared mean edge lengths. Must be positive and finite.
    std::optional<double> time_step_edges = {};
    /// The amount of all steps together: bumps of this radius lose half their height, smaller ones more (see
    /// smoothed_radius). Must be positive and finite.
    std::optional<LengthOnMesh> radius = {};
};

}  // namespace seamflow
