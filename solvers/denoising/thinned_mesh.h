#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Some vertices of a mesh, of which no two are neighbours, as a mesh of their own: about a quarter of them.
struct ThinnedMesh {
    PolygonMesh mesh;
    /// With twins. Rims may move; where a vertex is at a rim here alone, or held in the whole mesh, it is held.
    Topology topology;
    /// #V: their numbers in the whole mesh, ascending.
    std::vector<Index> vertices;
};

/// Each other vertex belongs to the nearest neighbour that is left, and a triangle is left between three vertices where
/// theirs met: that of the mesh whose vertices belong to all three.
/// @param mesh of triangles. @param topology its kinds and held vertices count; twins do not.
/// @param neighbours per vertex, along edges. @param positions #V by 3.
/// @param n_chosen #V: how often vertices were chosen before; those that were less often are preferred.
/// @param round makes another choice: among vertices that were chosen as often, one that depends on their positions and
///        not on their order.
ThinnedMesh thin_out(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                     const Points& positions, std::span<const int> n_chosen, std::uint64_t round);

}  // namespace seamflow
