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

/// What tells noise from shape in the displacements of the vertices around a place. Displacements are those along the
/// normals, in mean lengths of the edges at each vertex.
struct TakenStatistics {
    /// The median without sign.
    float median = 0.0F;
    /// The correlation of displacements at the two ends of edges: 0 or less for noise that is independent at
    /// neighbours.
    float correlation = 0.0F;
    /// How much the autocorrelation rises again: the most, over 24 directions and all distances of three edges and
    /// more, by which it exceeds its least value at shorter distances in this direction. Noise cannot be predicted; a
    /// pattern comes back.
    float revival = 0.0F;
    /// The mean fourth power over the square of the mean square: 3 for normal distributions, 1 for two levels.
    float kurtosis = 0.0F;
};

/// What tells noise from shape at a place.
struct PlaceStatistics {
    /// Of what the denoiser would take away.
    TakenStatistics fine;
    /// Of what a low-pass filter takes away, which reaches further.
    TakenStatistics wide;
    /// The median of the noise that the denoiser estimates at faces, in edge lengths.
    float noise = 0.0F;
    /// The power of the radius by which residuals of local quadratic fits grow, where they are least: 0 for noise, 3
    /// for smooth surfaces.
    float smoothness = 0.0F;
    /// The number of vertices that count.
    Index n_vertices = 0;
};

/// A surface and what is taken away from it. All members refer to the same mesh.
struct TakenAway {
    const Topology& topology;
    /// Per vertex: those at the other ends of its edges.
    const IndexLists& neighbours;
    /// #V by 3.
    const Points& positions;
    /// #V by 3, of length 1 or 0: of the denoised surface.
    const Points& vertex_normals;
    /// #V by 2: the displacement of each vertex along its normal, by the denoiser and by a low-pass filter, in mean
    /// lengths of the edges there.
    const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>& displacements;
    /// #V: mean lengths of edges.
    std::span<const double> edges;
    /// #F: the noise that the denoiser estimates, in edge lengths.
    std::span<const float> noise;
    /// #V: 1 for those that count for nothing.
    std::span<const std::uint8_t> is_left_out;
};

/// Measures what is taken away around a place.
/// @param middle a vertex with faces.
PlaceStatistics measure_place(const TakenAway& taken, Index middle);

/// Vertices spread over the surface, so that every vertex with faces is within some rings of one.
/// @param neighbours per vertex. @param positions #V by 3: the choice depends on them, and hardly on the order of
/// vertices. @returns ascending.
std::vector<Index> spread_places(const Topology& topology, const IndexLists& neighbours, const Points& positions,
                                 int rings);

}  // namespace seamflow
