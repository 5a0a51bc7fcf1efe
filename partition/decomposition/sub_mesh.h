#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The vertices Γ of a sub-mesh that it shares with other sub-meshes and that may move, with all data for the equations
/// there: the fan of its own faces on one side, the complement fan of all others on the other side. Every array has one
/// entry or one list per vertex of Γ. Vertices are local (see SubMesh).
struct SubMeshInterface {
    /// In ascending order.
    std::vector<Index> vertices;
    /// The neighbours v_{i-1} and v_{i+1} along the sub-mesh's boundary; at a junction those of the first of its fans.
    std::vector<Index> before;
    std::vector<Index> after;
    /// The own faces around the vertex, as indices into SubMesh::face_vertices.
    IndexLists own_faces;
    /// The other faces around the vertex, as indices into `halo_faces`.
    IndexLists complement_faces;
    /// All sub-meshes at the vertex, ascending, this one included, and the vertex's index in each.
    IndexLists sharing;
    IndexLists index_in_sharing;
    /// The faces of other sub-meshes that touch Γ, one list of vertices each.
    IndexLists halo_faces;

    [[nodiscard]] Index size() const { return static_cast<Index>(vertices.size()); }
};

/// The vertices of Γ in a sub-mesh's own part, which move to the centroids of their edge neighbours after a step.
struct CorrectedVertices {
    /// In ascending order.
    std::vector<Index> vertices;
    /// One list per vertex: its edge neighbours, in ascending order of their global indices.
    IndexLists neighbours;
};

/// One part of a cut mesh with its own copy of the vertices of its faces. Local vertices 0 to n_vertices - 1 are those
/// vertices; the n_halo next ones, the halo, are the vertices of faces of other sub-meshes that touch Γ. Equations may
/// take over `face_vertices` and `twin`; see also keep_faces_at_interface.
struct SubMesh {
    /// The faces, as indices into the whole mesh, in ascending order.
    std::vector<Index> faces;
    Index n_vertices = 0;
    Index n_halo = 0;
    /// n_vertices + n_halo; ascending within each of the two groups.
    std::vector<Index> local_to_global;
    /// The vertices of every face.
    IndexLists face_vertices;
    /// One entry per half-edge of the sub-mesh (numbered like face_vertices.values): the half-edge of the other face at
    /// the same edge, or -1 on the sub-mesh's own boundary.
    std::vector<Index> twin;
    /// n_vertices: 1 where a vertex stays where it is (see Topology::fixed).
    std::vector<std::uint8_t> fixed;
    /// n_vertices: 1 where this sub-mesh owns the vertex, which means that the whole mesh gets its position from here;
    /// exactly one sub-mesh owns each vertex that may move.
    std::vector<std::uint8_t> owned;
    SubMeshInterface interface;
    CorrectedVertices corrected;
};

/// The local index of a vertex among the sub-mesh's own vertices, or -1.
inline Index local_index(const SubMesh& sub_mesh, Index global_vertex)
{
    return position_in(std::span<const Index>(sub_mesh.local_to_global).first(sub_mesh.n_vertices), global_vertex);
}

}  // namespace seamflow
