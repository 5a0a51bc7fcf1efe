#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Γ of a sub-mesh: the vertices that it shares with other sub-meshes and that may move, with all data for the
/// equations there. The fan of its own faces is on one side of Γ, the complement fan of all other faces on the other
/// side. Every array has one entry or one list per vertex of Γ. Vertices are local (see SubMesh).
struct SubMeshInterface {
    /// In ascending order.
    std::vector<Index> vertices;
    /// The neighbours v_{i-1} and v_{i+1} along the sub-mesh's boundary; at a junction the neighbours of the sub-mesh's
    /// first fan.
    std::vector<Index> before;
    std::vector<Index> after;
    /// The own faces around the vertex, as indices into SubMesh::face_vertices.
    IndexLists own_faces;
    /// The other faces around the vertex, as indices into `halo_faces`.
    IndexLists complement_faces;
    /// All sub-meshes at the vertex, ascending, this one included; and the local index of the vertex in each of them.
    IndexLists sharing;
    IndexLists index_in_sharing;
    /// The faces of other sub-meshes that touch Γ, one list of vertices each.
    IndexLists halo_faces;

    [[nodiscard]] Index size() const { return static_cast<Index>(vertices.size()); }
};

/// The vertices of Γ in a sub-mesh's own part that are corrected: they move to the centroids of their edge neighbours
/// after a step.
struct CorrectedVertices {
    /// In ascending order.
    std::vector<Index> vertices;
    /// One list per vertex: its edge neighbours, in ascending order of their global indices.
    IndexLists neighbours;
};

/// One part of a cut mesh with its own copy of the vertices of its faces. These own vertices have the local numbers 0
/// to n_vertices - 1. The next n_halo numbers are the halo: the vertices of faces of other sub-meshes that touch Γ.
/// Equations may take over `face_vertices` and `twin`; see also keep_faces_at_interface.
struct SubMesh {
    /// The faces, by their numbers in the whole mesh, ascending.
    std::vector<Index> faces;
    Index n_vertices = 0;
    Index n_halo = 0;
    /// n_vertices + n_halo: the number of each local vertex in the whole mesh; ascending within each of the two groups.
    std::vector<Index> local_to_global;
    /// The vertices of every face.
    IndexLists face_vertices;
    /// One entry per half-edge of the sub-mesh (numbered like face_vertices.values): the half-edge of the other face at
    /// the same edge, or -1 on the sub-mesh's own boundary.
    std::vector<Index> twin;
    /// n_vertices: 1 for vertices that do not move (see Topology::fixed).
    std::vector<std::uint8_t> fixed;
    /// n_vertices: 1 for vertices that this sub-mesh owns, which means that the whole mesh gets their positions from
    /// here. Exactly one sub-mesh owns each vertex that may move.
    std::vector<std::uint8_t> owned;
    SubMeshInterface interface;
    CorrectedVertices corrected;
};

/// The local index of a vertex among the sub-mesh's own vertices, or -1.
inline Index local_index(const SubMesh& sub_mesh, Index global_vertex)
{
    return find_in(std::span<const Index>(sub_mesh.local_to_global).first(sub_mesh.n_vertices), global_vertex);
}

}  // namespace seamflow
