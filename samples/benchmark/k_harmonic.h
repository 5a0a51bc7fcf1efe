#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// One solver of a k-harmonic step (M + dtᵏ K (M⁻¹ K)ᵏ⁻¹) u = M x with x the positions: implicit fairing (Desbrun et
/// al. 1999) with k = 1, surface modelling (Jacobson et al. 2010) with k = 2 and 3.
struct KHarmonicRow {
    int k = 1;
    std::string method;
    /// Why there is no result; empty: there is one.
    std::string failure;
    /// Seconds: all that is done once for the matrix, analysis and cut included; and what a right-hand side of three
    /// columns takes.
    double factor = 0.0;
    double solve = 0.0;
    /// The largest |b - A u| / (|A| |u| + |b|) of all entries: what LAPACK calls the componentwise backward error.
    double error = 0.0;
};

/// Solves such steps for k = 1, 2 and 3 with ours, with CHOLMOD in the order of METIS, with our factorisation of the
/// whole matrix, and by conjugate gradients with incomplete Cholesky, in this process.
/// @param flow dt, the threads, and a Laplacian with areas for masses.
/// @param orders the values of k.
std::vector<KHarmonicRow> run_k_harmonic(const PolygonMesh& mesh, const FlowOptions& flow,
                                         const std::vector<int>& orders);

/// A table for each k, the fastest first.
void print_k_harmonic(std::ostream& out, const std::vector<KHarmonicRow>& rows);
nlohmann::ordered_json k_harmonic_json(const std::vector<KHarmonicRow>& rows);

}  // namespace seamflow
