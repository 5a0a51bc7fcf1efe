#pragma once

#include <vector>

#include "partition/decomposition/overlap.h"
#include "partition/decomposition/sub_mesh.h"

namespace seamflow {

/// A part of a cut, grown, for equations at its vertices that are those of the whole mesh.
struct GrownPart {
    /// The part grown by its own layers and further by those that the equations reach into. Of its lists `interface`
    /// and `seam` are empty, and it has no halo; it owns vertices of the part itself alone.
    SubMesh sub_mesh;
    /// The vertices (local, ascending) that may move, of the part grown by its own layers.
    std::vector<Index> unknowns;
};

/// Cuts out part s. May be called for several parts at once.
/// @param overlap `layers` by which its equations overlap those of other parts. Parts of lower rank are not entered.
/// @param reach layers of faces beyond on which these equations depend. With 2 they have all faces around each of their
///        vertices, and the faces across the edges of these.
/// @param faces those of the part itself, in ascending order.
GrownPart make_grown_part(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, int reach, Index s,
                          std::vector<Index> faces);

}  // namespace seamflow
