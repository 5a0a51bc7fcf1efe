#pragma once

#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// Δ_U (Taubin, A signal processing approach to fair surface design, 1995, with uniform weights). The edge e has K =
/// [1 -1; -1 1], and M_v is h²/4 for each edge at v, counted half for each of its faces.
struct Uniform {
    static constexpr LaplacianTraits traits{Laplacian::Uniform, "uniform", "Δ_U", Reach::Edges, Divisor::Nothing, true};
    static constexpr bool averages_mass = false;

    /// Contribution of one edge: see kernels.h.
    class Edge {
      public:
        explicit Edge(double mass)
            : mass_(mass)
        {
        }

        /// factor · (-K) of its two ends.
        [[nodiscard]] static double weight(double factor) { return factor; }

        /// M_v is the sum of these, in length².
        [[nodiscard]] double mass() const { return mass_; }

      private:
        double mass_;
    };

    [[nodiscard]] Edge edge(const Point&) const { return Edge(0.25 * edge_length * edge_length); }

    /// h, in length.
    double edge_length = 1.0;
};

}  // namespace seamflow
