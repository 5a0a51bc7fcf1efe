#pragma once

#include <cstdint>
#include <vector>

#include "partition/polygon_mesh.h"

/// Noise on meshes whose true surface is known, what other methods make of it, and what is left.
namespace seamflow::test {

/// The mesh with every vertex displaced along a random direction by a normally distributed length.
/// @param sigma its standard deviation, in mean edges.
PolygonMesh with_gaussian_noise(const PolygonMesh& mesh, double sigma, std::uint32_t seed);

/// How far a result is from the truth, which has the same faces.
struct Denoised {
    /// Between the normals of faces, in degrees, on average.
    double angle = 0.0;
    /// From the vertices of the result to the true surface, in mean edges of that, on average.
    double distance = 0.0;
    /// Relative to the true one, with its sign.
    double volume = 0.0;
};

Denoised compare_with_truth(const PolygonMesh& truth, const PolygonMesh& result);

/// The mean angle alone.
double angle_to_truth(const PolygonMesh& truth, const PolygonMesh& result);

/// Taubin, A signal processing approach to fair surface design, 1995: λ = 0.5 and μ = -0.53 in turn, with the mean of
/// the neighbours.
PolygonMesh taubin_smoothed(PolygonMesh mesh, int iterations);

/// Bilateral normal filtering of Zheng et al., Bilateral normal filtering for mesh denoising, 2011: the local iterative
/// scheme. Faces that share a vertex are neighbours, σ_c is their mean centroid distance across edges; vertices follow
/// by the scheme of Sun et al. 2007.
struct BilateralFilter {
    /// σ_s, the chord between unit normals.
    double sigma = 0.3;
    int normal_iterations = 20;
    int vertex_iterations = 20;
};

PolygonMesh bilaterally_filtered(PolygonMesh mesh, const BilateralFilter& filter);

/// What the filter leaves with the parameters that leave least, of a grid of them.
PolygonMesh best_of_bilateral_filters(const PolygonMesh& truth, const PolygonMesh& noisy);

}  // namespace seamflow::test
