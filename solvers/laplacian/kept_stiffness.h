#pragma once

#include <memory>

#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

/// A Laplacian with the K of fixed positions, which is assembled once.
/// @param n_vertices the number of all vertices.
/// @param positions at least n_vertices by 3; needed only during the call.
/// @param keeps_mass whether M is also computed from these positions; otherwise it follows the mesh.
std::unique_ptr<SymmetricLaplacian> keep_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices,
                                                   const Points& positions, bool keeps_mass = false);

}  // namespace seamflow
