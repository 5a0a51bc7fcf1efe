#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Filter of the solution of a step. S maps positions to the result of a step; of a mode of the surface with λ, dt
/// times its eigenvalue of Δ, it leaves 1 / (1 + λ).
enum class Filter {
    /// The k-harmonic step of order k, (M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) Vⁿ⁺¹ = M Vⁿ, which leaves 1 / (1 + λᵏ). Order 1 is S; 2
    /// is implicit surface diffusion (Desbrun et al., Implicit Fairing of Irregular Meshes, 1999). The higher the
    /// order, the less of large features and the more of small ones is removed.
    Diffusion,
    /// V ← V + Σ of S applied to what is left of V, m times in all, which leaves 1 - (λ / (1 + λ))ᵐ. Large features
    /// shrink only to order m; small ones stay longer than with Diffusion.
    LowPass,
};

/// A filter of some order: a polynomial of S, so that a step has one factorisation and several solutions.
struct StepFilter {
    Filter kind = Filter::Diffusion;
    /// See orders_of.
    int order = 1;
    /// Absolute error allowed in 1 / (1 + λᵏ), which is a polynomial of S in effect. At least 1e-12.
    double tolerance = 1e-2;

    /// Whether it is S itself.
    [[nodiscard]] bool is_plain() const { return kind == Filter::Diffusion && order == 1; }

    friend bool operator==(const StepFilter&, const StepFilter&) = default;
};

/// The orders that a filter has: the least, which it has by default, and the most.
std::pair<int, int> orders_of(Filter filter);

/// The fraction of a mode with λ ≥ 0 that a step leaves.
double transfer(const StepFilter& filter, double lambda);

/// The λ of which a step leaves `left`: inverse of `transfer`.
/// @param left above 0 and below 1.
double lambda_of(const StepFilter& filter, double left);

/// Number of solutions of a step, including that of S V.
int n_solutions(const StepFilter& filter);

/// Rows of arrays that belong together, #rows by 3 each.
using PointBlocks = std::vector<Points>;

/// Completes a filter that is not plain. With u = 1 - S, the low-pass filter subtracts uᵐ V from V, and the k-harmonic
/// step uᵏ / (1 - k u S) V for k = 2 and 3, whose denominator is a polynomial of u S, exact at u S = 0: nothing is
/// taken from large features, and all of small ones.
/// @param rest in: u V, that is V - S V; out: what to subtract from V.
/// @param solve returns S D; the result may change with the next call.
void apply_filter(const StepFilter& filter, PointBlocks& rest,
                  const std::function<const PointBlocks&(const PointBlocks& data)>& solve, const Executor& exec);

}  // namespace seamflow
