#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/denoise.h"
#include "partition/polygon_mesh.h"

/// Noise on meshes whose true surface is known, what other methods make of it, and what is left.
namespace seamflow::test {

/// The mesh with every vertex displaced along a random direction by a normally distributed length.
/// @param sigma its standard deviation, in mean edges.
PolygonMesh with_gaussian_noise(const PolygonMesh& mesh, double sigma, std::uint32_t seed);

/// Calls denoise without looking on.
DenoiseReport denoise_in_place(PolygonMesh& mesh, const DenoiseOptions& options = {});

/// Whether one of some remarks is of this kind.
bool names(const std::vector<Remark>& remarks, const std::string& kind);

/// The largest change of a coordinate.
double furthest(const PolygonMesh& mesh, const PolygonMesh& before);

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
/// the neighbours, on the boundary of those along it, as MeshLab has it.
PolygonMesh taubin_smoothed(PolygonMesh mesh, int iterations);

/// Parameters of the bilateral normal filtering of Zheng et al., Bilateral normal filtering for mesh denoising, 2011,
/// to be tried all with all; by default those of the table in engine/accuracy.md. It is the local iterative scheme:
/// faces that share a vertex are neighbours, σ_c is their mean centroid distance across edges; vertices follow by the
/// scheme of Sun et al. 2007.
struct BilateralGrid {
    /// σ_s, of the chord between unit normals.
    std::vector<double> sigmas{0.2, 0.25, 0.3, 0.35, 0.4};
    /// Ascending.
    std::vector<int> normal_iterations{10, 20, 30, 40, 60, 80};
    std::vector<int> vertex_iterations{20, 50};
};

/// The result with the parameters that leave the least angle.
PolygonMesh best_of_bilateral_filters(const PolygonMesh& truth, const PolygonMesh& noisy,
                                      const BilateralGrid& grid = {});

}  // namespace seamflow::test
