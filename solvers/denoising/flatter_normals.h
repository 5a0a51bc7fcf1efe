#pragma once

#include <cstdint>
#include <span>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/denoised_normals.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// The arguments of take_flatter_normals. All members refer to the same mesh.
struct NoisySurface {
    const PolygonMesh& mesh;
    /// Twins are not used.
    const Topology& topology;
    const VertexAverages& averages;
    /// #F: 1 or -1, by which vector areas are multiplied so that they point to one side (see face_signs); or empty.
    std::span<const std::int8_t> signs;
    /// #V by 3: the noisy positions.
    const Points& positions;
    /// #V: the share of its displacement that each vertex moves by, from 0 to 1.
    std::span<const double> shares;
};

/// Replaces estimated normals, face by face, by flatter ones: their bilateral means (Zheng et al., Bilateral normal
/// filtering for mesh denoising, 2011), several rounds of them. Under much noise, estimates differ even within a flat
/// facet, and flatter normals are nearer to the truth. Bent surfaces would lose shape. An estimate is replaced only
/// where all of these hold around its face, and in part at their limits:
/// - The noise is so large that take_smoother_places does little.
/// - Flatter normals of faces that share an edge are nearly equal, or differ by a clear edge. On bent surfaces many
///   differ by something between.
/// - Patches keep their directions. The vector area of a patch depends on its rim alone and has little noise, so that
///   the noisy surface shows these directions. Flatter normals must hardly miss them by more than the estimates do.
/// Normals of faces without noise stay. Bits do not depend on how loops are run.
/// @returns whether any normal was replaced.
bool take_flatter_normals(const NoisySurface& surface, DenoisedNormals& estimated, const Executor& exec = run_serially);

}  // namespace seamflow
