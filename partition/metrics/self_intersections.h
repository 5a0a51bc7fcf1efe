#pragma once

#include <array>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Two faces, the lower number first.
using FacePair = std::array<Index, 2>;

/// The search stops at this many pairs: in a collapsed surface, each face may cross all others.
inline constexpr std::size_t most_self_intersections = 1'000'000;

/// The pairs of faces that have a point in common beyond the vertices and edges that they share: where one pierces the
/// other, touches it, lies on it in one plane, or is folded back onto it along their edge (see cross, which is exact).
/// Polygons are triangulated (see triangulation.h); self-crossings of polygons are ignored. Shared vertices are found
/// by positions: if a file duplicates vertices along the seams of a texture, faces that meet there do not cross. Faces
/// that lie on each other with all their corners cross. Triangles without area, and those with a corner that is not
/// finite, cross nothing.
///
/// Nearly linear in the size of the mesh if faces are about as large as their neighbours, however many share an edge or
/// a vertex. The same pairs for every executor.
/// @param positions #V by 3, not necessarily those of the mesh; need not be finite.
/// @returns ascending; at most most_self_intersections pairs.
std::vector<FacePair> self_intersections(const PolygonMesh& mesh, const Points& positions,
                                         const Executor& exec = run_serially);

}  // namespace seamflow
