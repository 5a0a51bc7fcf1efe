#pragma once

#include <memory>

#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// Δ_F (paper, eq. 14; see method of Fujiwara 1995). Rows: (nᵥ / Σ‖e‖) Σⱼ (v - vⱼ) / ‖v - vⱼ‖, sums over
/// the edges at v, those on the boundary counted half, nᵥ their number.
std::unique_ptr<LaplacianAssembler> make_fujiwara_assembler(const FaceView& faces);

}  // namespace seamflow
