#pragma once

#include <cassert>
#include <span>
#include <vector>

#include "partition/decomposition/index_set.h"
#include "partition/decomposition/sub_mesh.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// The building blocks of all sub-meshes, overlapping or not.
namespace seamflow {

/// Whether vertex v lies on Γ: it may move and has faces of several labels.
bool is_on_interface(const Topology& topology, std::span<const Index> labels, Index v);

/// A sub-mesh under construction, with lookup tables.
struct SubMeshDraft {
    SubMesh sub_mesh;
    /// The own vertices, the halo vertices and the faces, by their numbers in the whole mesh.
    IndexSet vertices;
    IndexSet halo;
    IndexSet faces;

    /// The local index of a vertex of the sub-mesh or its halo.
    [[nodiscard]] Index local(Index v) const
    {
        const Index own = vertices[v];
        assert((own >= 0 || halo[v] >= 0) && "the sub-mesh or its halo has the vertex");
        return own >= 0 ? own : sub_mesh.n_vertices + halo[v];
    }
};

/// Makes a sub-mesh of the given faces: with its vertices, their fixedness, and its half-edges, but without data of
/// other sub-meshes, and owning no vertices.
/// @param faces in ascending order.
SubMeshDraft copy_faces(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> faces);

/// Makes the given vertices, except for the sub-mesh's own, its halo.
void append_halo(std::span<const Index> vertices, SubMeshDraft& draft);

/// Appends a vertex of Γ that is corrected after a step, and its edge neighbours, which must all be in the sub-mesh or
/// its halo.
void append_corrected(Index v, std::span<const Index> neighbours, SubMeshDraft& draft);

/// Fills in the sub-meshes that share each vertex of an interface: SubMeshInterface::sharing and index_in_sharing.
/// @param labels #F. @param sub_meshes all of them. @param local_to_global of the sub-mesh with the interface.
void list_sharing(const Topology& topology, std::span<const Index> labels, std::span<const SubMesh> sub_meshes,
                  SubMeshInterface& interface, std::span<const Index> local_to_global);

}  // namespace seamflow
