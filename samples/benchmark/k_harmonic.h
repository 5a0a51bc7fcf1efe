#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "samples/benchmark/table.h"

namespace seamflow {

/// The table of solvers of k-harmonic steps (M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) u = M x with x the positions: implicit fairing
/// (Desbrun et al. 1999) with k = 1, surface modelling (Jacobson et al. 2010) with k = 2 and 3. "factor" is all that is
/// done once for the matrix, analysis and cut included, "solve" what a right-hand side of three columns takes, and the
/// error the largest |b - A u| / (|A| |u| + |b|) of all entries: what LAPACK calls the componentwise backward error.
Table k_harmonic_table(std::ostream& out);

/// Solves such steps with ours, with CHOLMOD in the order of METIS, with our factorisation of the whole matrix, and by
/// conjugate gradients with incomplete Cholesky, in this process.
/// @param name of the mesh.
/// @param flow dt, the threads, and a Laplacian with areas for masses.
/// @param orders the values of k, from 1 to 3.
void add_k_harmonic(Table& table, const std::string& name, const PolygonMesh& mesh, const FlowOptions& flow,
                    const std::vector<int>& orders);

}  // namespace seamflow
