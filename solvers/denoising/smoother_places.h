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
    /// #V by 3: with noise.
    const Points& before;
    /// #F by 3: the wanted normals, to which vertices were fitted.
    const Points& normals;
    /// #V: the part of each displacement that vertices go, from 0 to 1.
    std::span<const double> parts;
};

/// Replaces a denoised surface, place by place, by one whose normals diffuse between edges (see
/// smoothed_between_edges), where that one is smoother and yet no further from the noisy surface than the noise
/// explains: on planes, cylinders and other parts that hardly bend, and where the noise is small relative to edges, so
/// that estimates of single normals are hardly better than it. The amount is 8 and 32 squared mean edge lengths of each
/// component, of which the larger one counts where the smaller one did, or alone if the surface is large. Boundaries
/// stay as they are. Components do not matter to each other. A large surface stays as it is unless a sample of it gets
/// smoother. Bits do not depend on how loops are run.
/// @param components of faces that share edges. @param angle of edges, in degrees. @param result #V by 3.
void take_smoother_places(const DenoisedSurface& surface, const Components& components, double angle, Points& result,
                          const Executor& exec = run_serially);

}  // namespace seamflow
