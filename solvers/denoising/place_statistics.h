#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Statistics of the displacements of the vertices around a place (a vertex, see NoisyPlaces), by which noise and shape
/// are distinguished. Displacements are those along the normals, in mean lengths of the edges at each vertex.
struct RemovalStatistics {
    /// The median of the absolute values.
    float median = 0.0F;
    /// The correlation of displacements at the two ends of edges: 0 or less for noise that is independent at
    /// neighbours.
    float correlation = 0.0F;
    /// How much the autocorrelation (the correlation of the displacements at two vertices, by their distance and
    /// direction) rises again after it has fallen: the most, over 24 directions and all distances of 3 to 18 edges, by
    /// which it exceeds its least value at shorter distances in this direction. Noise cannot be predicted; a pattern
    /// comes back.
    float revival = 0.0F;
    /// The mean fourth power over the square of the mean square: 3 for normal distributions, 1 for two values of equal
    /// frequency.
    float kurtosis = 0.0F;
};

/// All statistics of a place.
struct PlaceStatistics {
    /// Statistics of the displacements that the denoiser would remove.
    RemovalStatistics fine;
    /// Statistics of the displacements that a low-pass filter, which reaches further, would remove.
    RemovalStatistics wide;
    /// The median of the noise that the denoiser estimates at faces, in edge lengths.
    float noise = 0.0F;
    /// The power of the radius with which the least residuals of local quadratic fits grow: 0 for noise, 3 for smooth
    /// surfaces.
    float smoothness = 0.0F;
    /// The number of vertices that were measured.
    Index n_vertices = 0;
};

/// A surface, and the displacements that a denoiser and a filter would remove. All members refer to the same mesh.
struct TakenAway {
    const Topology& topology;
    /// Per vertex: the vertices at the other ends of its edges.
    const IndexLists& neighbours;
    /// #V by 3: the noisy positions.
    const Points& positions;
    /// #V by 3: the normals of the denoised surface, of length 1 or 0.
    const Points& vertex_normals;
    /// #V by 2: the displacement of each vertex along its normal, by the denoiser and by a low-pass filter, in mean
    /// lengths of the edges at the vertex.
    const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>& displacements;
    /// #V: the mean lengths of the edges at each vertex.
    std::span<const double> edges;
    /// #F: the noise that the denoiser estimates, in edge lengths.
    std::span<const float> noise;
    /// #V: 1 for vertices that do not count.
    std::span<const std::uint8_t> is_left_out;
};

/// Measures the displacements around a place.
/// @param middle the vertex of the place, which must have faces.
PlaceStatistics measure_place(const TakenAway& taken, Index middle);

/// Chooses vertices spread over the surface, so that every vertex with faces is within some rings of a chosen one.
/// @param neighbours per vertex. @param positions #V by 3: the choice depends on them, and hardly on the order of
/// vertices. @param rings the number of rings. @returns ascending.
std::vector<Index> spread_places(const Topology& topology, const IndexLists& neighbours, const Points& positions,
                                 int rings);

}  // namespace seamflow
