#pragma once

#include <span>
#include <vector>

#include "solvers/laplacian/flow_terms.h"

namespace seamflow {

/// The attachment of a sub-mesh to V⁰: adds dt M w to the diagonal of M + dt K, and dt M w V⁰ to the right-hand side. A
/// vertex with step scale s takes a step of s dt: M is divided by s, and w is multiplied by s.
struct Screening {
    /// Per own vertex: w, in 1/length². Empty without attachment.
    std::vector<double> weights;
    /// #own by 3: V⁰.
    Points initial = Points(0, 3);
    /// Per own vertex: s. Empty: 1 everywhere.
    std::vector<double> step_scales = {};

    [[nodiscard]] bool exists() const { return !weights.empty(); }
    [[nodiscard]] double step_scale(Index v) const { return step_scales.empty() ? 1.0 : step_scales[v]; }
    [[nodiscard]] double weight(Index v) const { return exists() ? weights[v] * step_scale(v) : 0.0; }
};

/// The attachment and the step scales of a sub-mesh.
/// @param own the own vertices of the sub-mesh, by their numbers in the whole mesh.
inline Screening make_screening(const FlowTerms& terms, std::span<const Index> own)
{
    Screening screening;
    for (const Index v : terms.step_scales.empty() ? std::span<const Index>() : own)
        screening.step_scales.push_back(terms.step_scale(v));
    if (!terms.attaches())
        return screening;
    screening.initial = rows_of(*terms.initial, own);
    screening.weights.reserve(own.size());
    for (const Index v : own)
        screening.weights.push_back(terms.weight(v));
    return screening;
}

}  // namespace seamflow
