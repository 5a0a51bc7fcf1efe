#pragma once

#include <memory>

#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// Δ_A = W_V d0ᵀ R W1 Rᵀ d0 (paper, eq. 15), without a stabilisation term. Per face, d0ᵀ R W1 Rᵀ d0 = B Bᵀ / |f|
/// with the corner bisectors bₖ as rows of B (see corner_bisector).
std::unique_ptr<LaplacianAssembler> make_alexa_wardetzky_assembler(const FaceView& faces);

}  // namespace seamflow
