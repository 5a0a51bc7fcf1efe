#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// About a quarter of the vertices of a mesh, of which no two are neighbours, as a mesh of their own.
struct ThinnedMesh {
    PolygonMesh mesh;
    /// With twins. Rims may move. A vertex is fixed if it does not move in the whole mesh, or if its kind differs from
    /// its kind there, as at a rim of the thinned mesh alone.
    Topology topology;
    /// #V: the numbers of the vertices in the whole mesh, ascending.
    std::vector<Index> vertices;
};

/// Thins a mesh. Each vertex that is left out belongs to the nearest neighbour that is kept. A triangle of the mesh
/// whose vertices belong to three different kept vertices becomes a triangle between these.
/// @param mesh of triangles. @param topology its kinds and fixed vertices are used; twins are not.
/// @param neighbours per vertex, along edges. @param positions #V by 3.
/// @param n_chosen #V: how often vertices were chosen before; vertices that were chosen less often are preferred.
/// @param round with another number, another choice is made among vertices that were chosen equally often. The choice
///        depends on the positions of vertices and not on their order.
ThinnedMesh thin_out(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                     const Points& positions, std::span<const int> n_chosen, std::uint64_t round);

}  // namespace seamflow
