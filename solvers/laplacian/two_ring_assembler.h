#pragma once

#include <memory>

#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// The assembler of Δ_P (see PtackovaVelho).
std::unique_ptr<LaplacianAssembler> make_two_ring_assembler(const FaceView& faces);

}  // namespace seamflow
