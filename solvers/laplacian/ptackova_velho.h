#pragma once

#include <memory>

#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// Δ_P = -W_V fvᵀ d1 A W1 Rᵀ d0 (paper, eq. 16). W1 Rᵀ d0 x is, for each half-edge h of a face, the flux
/// w_h = ⟨e_h, Σₖ bₖ xₖ⟩ / |f| of x across it (bₖ: see corner_bisector). The fluxes of one face sum to zero, so that A
/// leaves per face f: Φ_f = ½ (Σ over edges shared with a face g of w in g - Σ over edges without of w in f), and Δ_P x
/// = W_V fvᵀ Φ.
std::unique_ptr<LaplacianAssembler> make_ptackova_velho_assembler(const FaceView& faces);

}  // namespace seamflow
