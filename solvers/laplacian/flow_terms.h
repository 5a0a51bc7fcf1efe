#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Parameters of a step, (M + dt K) Vᵏ⁺¹ = M Vᵏ, besides dt and the positions Vᵏ at which M and K are taken.
struct FlowTerms {
    /// #V by 3: V⁰ of the whole mesh, if any of the following terms is used; read only while systems are constructed.
    const Points* initial = nullptr;
    /// Whether K is that of V⁰ in all steps: the conformalized flow (Kazhdan, Solomon, Ben-Chen 2012).
    bool keeps_stiffness = false;
    /// Whether M is also that of V⁰ in all steps: the linear flow, which keeps K, too. Not for sweeps.
    bool keeps_mass = false;
    /// The weight w of the attachment to V⁰, (M + dt K + dt M w) Vᵏ⁺¹ = M Vᵏ + dt M w V⁰, in 1/length²: one per vertex
    /// (#V), or, if empty, `uniform_weight` for all.
    std::span<const double> weights = {};
    double uniform_weight = 0.0;
    /// The step scale s of each vertex (#V), from 0 to 1: M / s replaces M, and w s replaces w, so that the time step
    /// is s dt there. A vertex with s = 0 is fixed. Empty: 1 everywhere.
    std::span<const double> strengths = {};

    [[nodiscard]] bool attaches() const { return !weights.empty() || uniform_weight > 0.0; }
    [[nodiscard]] double strength(Index v) const { return strengths.empty() ? 1.0 : strengths[v]; }
    [[nodiscard]] double weight(Index v) const { return weights.empty() ? uniform_weight : weights[v]; }
};

/// The rows of some vertices.
/// @param of_mesh #V by 3.
inline Points rows_of(const Points& of_mesh, std::span<const Index> vertices)
{
    Points rows(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        rows.row(static_cast<Eigen::Index>(i)) = of_mesh.row(vertices[i]);
    return rows;
}

}  // namespace seamflow
