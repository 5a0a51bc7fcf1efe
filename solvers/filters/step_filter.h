#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The filter that a step applies. S maps positions to the result of a plain step. A mode of the surface has λ, dt
/// times its eigenvalue of Δ; S multiplies it by 1 / (1 + λ).
enum class Filter {
    /// The k-harmonic step of order k, (M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) Vⁿ⁺¹ = M Vⁿ, which leaves 1 / (1 + λᵏ). Order 1 is S; 2
    /// is implicit surface diffusion (Desbrun et al., Implicit Fairing of Irregular Meshes, 1999). The higher the
    /// order, the less of large features and the more of small ones is removed.
    Diffusion,
    /// S is applied m times in all: first to V, then each time to the part of V that the sum of the results still
    /// lacks. The sum has a mode times 1 - (λ / (1 + λ))ᵐ. Large features shrink only to order m; small features stay
    /// longer than with Diffusion.
    LowPass,
};

/// A filter of some order: a polynomial of S, so that a step has one factorisation and several solutions.
struct StepFilter {
    Filter kind = Filter::Diffusion;
    /// The order, within the bounds of orders_of.
    int order = 1;
    /// The absolute error allowed in 1 / (1 + λᵏ), which is approximated by a polynomial of S. At least 1e-12.
    double tolerance = 1e-2;

    /// Whether the filter is S itself.
    [[nodiscard]] bool is_plain() const { return kind == Filter::Diffusion && order == 1; }

    friend bool operator==(const StepFilter&, const StepFilter&) = default;
};

/// The least order of a filter, which is the default, and its largest order.
std::pair<int, int> orders_of(Filter filter);

/// The factor by which a step multiplies a mode with λ ≥ 0.
double transfer(const StepFilter& filter, double lambda);

/// The λ of the modes that a step multiplies by `left`: inverse of `transfer`.
/// @param left above 0 and below 1.
double lambda_of(const StepFilter& filter, double left);

/// The number of solutions of a step, including that of S V.
int n_solutions(const StepFilter& filter);

/// Blocks of rows that together are one array of points, #rows by 3 each.
using PointBlocks = std::vector<Points>;

/// Completes a filter that is not plain. With u = 1 - S, the low-pass filter subtracts uᵐ V from V, and the k-harmonic
/// step subtracts uᵏ / (1 - k u S) V for k = 2 and 3. The inverse of the denominator is approximated by a polynomial of
/// u S that is exact at u S = 0, where features are very large or very small.
/// @param rest in: u V, that is V - S V; out: the part to subtract from V.
/// @param solve returns S D; the result may change with the next call.
void apply_filter(const StepFilter& filter, PointBlocks& rest,
                  const std::function<const PointBlocks&(const PointBlocks& data)>& solve, const Executor& exec);

}  // namespace seamflow
