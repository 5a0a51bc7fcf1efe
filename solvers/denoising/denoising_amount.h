#pragma once

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// How much to smooth, and the expected result.
struct DenoisingAmount {
    /// t of the filter H = (1 + (t L)³)⁻¹, without a unit; 0: no filter reduces the risk by more than a tenth.
    double amount = 0.0;
    /// The expected mean squared distance from the true surface, along the normals, after the filter: length².
    double risk = 0.0;
    /// The root mean square displacement of vertices along the normals by the filter, in units of length. At most the
    /// noise.
    double move = 0.0;
};

/// The amount of the filter X′ = (1 + (t L)³)⁻¹ X that comes nearest to the true surface, L = D⁻¹ K with uniform
/// weights; vertices that do not move have rows of the identity.
///
/// Noise that is independent and of variance σ² in each coordinate has the risk
///     mean (n·(H X - X))² - σ² + 2 σ² tr(H) / #V
/// along the normals n of H X, whatever the true surface is (Stein, Estimation of the Mean of a Multivariate Normal
/// Distribution, 1981), the trace by a random vector of ±1 (Hutchinson, 1990). σ is assumed to be within 0.9 and 1.15
/// times the given value. t has the least regret: the excess of the risk over the least possible risk, at the worse end
/// of that range (Savage, The Theory of Statistical Decision, 1951). Many t may be nearly as good as the best, as with
/// correlated noise: t is their mean, so that it does not jump from one to another. A little more, which is added, is
/// better for normals and hardly worse for distances. No t is taken that moves vertices by more than σ (Morozov, On the
/// Solution of Functional Equations by the Method of Regularization, 1966).
///
/// All t are found from one Chebyshev basis of L on a sample of the mesh (see take_filter_sample); nothing is
/// factorised, and the result does not depend on how the loop is divided.
/// @param noise σ: the standard deviation along the normals, in units of length, as measure_noise gives it.
DenoisingAmount denoising_amount(const PolygonMesh& mesh, const Topology& topology, double noise,
                                 const Executor& exec = run_serially);

}  // namespace seamflow
