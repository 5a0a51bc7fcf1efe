#pragma once

#include <span>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The arguments of take_smoother_places. All members refer to the same mesh.
struct DenoisedSurface {
    const PolygonMesh& mesh;
    const Topology& topology;
    /// #V by 3: the noisy positions.
    const Points& before;
    /// #F by 3: the estimated normals, to which the vertices were fitted.
    const Points& normals;
    /// #V: the share of its displacement that each vertex moves by, from 0 to 1.
    std::span<const double> shares;
};

/// Replaces a denoised surface, place by place, by one whose normals diffuse between edges (see
/// smoothed_between_edges), where that surface is smoother and yet no further from the noisy surface than the noise
/// explains: on planes, cylinders and other regions that hardly bend, and where the noise is small relative to edges,
/// so that estimates of single normals are hardly better than the noisy normals. The amount is 8 and 32 squared mean
/// edge lengths of each component. The larger amount is tried in the components where the smaller one was used at some
/// place, or alone if the surface is large. Boundaries do not change. Components do not affect each other. A large
/// surface does not change unless a sample of it becomes smoother. Bits do not depend on how loops are run.
/// @param components of faces that share edges. @param angle of edges, in degrees. @param result #V by 3.
void take_smoother_places(const DenoisedSurface& surface, const Components& components, double angle, Points& result,
                          const Executor& exec = run_serially);

}  // namespace seamflow
