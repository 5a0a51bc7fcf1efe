#pragma once

#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// Δ_F (paper, eq. 14; see method of Fujiwara 1995). Rows: (nᵥ / Σ‖e‖) Σⱼ (v - vⱼ) / ‖v - vⱼ‖, sums over the edges at
/// v, each counted half for each of its faces, nᵥ their number. So the edge e has K = [1 -1; -1 1] / ‖e‖, and M_v is
/// the mean of ‖e‖ over the edges at v.
struct Fujiwara {
    static constexpr LaplacianTraits traits{Laplacian::Fujiwara,  "fujiwara", "Δ_F", Reach::Edges,
                                            Divisor::EdgeLengths, true,       true};

    static constexpr bool averages_mass = true;

    /// Contribution of one edge: see kernels.h.
    class Edge {
      public:
        explicit Edge(const Point& difference)
            : length_(difference.norm())
        {
        }

        /// factor · (-K) of its two ends (eq. 14), K being in 1/length.
        [[nodiscard]] double weight(double factor) const { return factor / length_; }

        /// The length of the edge; M_v is the mean over the edges at v.
        [[nodiscard]] double mass() const { return length_; }

      private:
        double length_;
    };

    [[nodiscard]] static Edge edge(const Point& difference) { return Edge(difference); }
};

}  // namespace seamflow
