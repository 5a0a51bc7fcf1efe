#include "partition/decomposition/local_mesh.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "partition/labels.h"

namespace seamflow {

namespace {

/// Lists the vertices of the faces, numbers them in the order of their global indices, and sets the faces in these
/// local numbers.
void copy_vertices(const PolygonMesh& mesh, SubMeshDraft& draft)
{
    SubMesh& sub_mesh = draft.sub_mesh;
    auto& [offsets, corners] = sub_mesh.face_vertices;
    offsets.reserve(sub_mesh.faces.size() + 1);
    for (const Index f : sub_mesh.faces)
        offsets.push_back(offsets.back() + static_cast<Index>(mesh.face(f).size()));
    corners.reserve(offsets.back());
    for (const Index f : sub_mesh.faces)
        for (const Index v : mesh.face(f))
            corners.push_back(v);
    draft.vertices = IndexSet(corners);
    sub_mesh.local_to_global = draft.vertices.ascending();
    sub_mesh.n_vertices = static_cast<Index>(sub_mesh.local_to_global.size());
    for (Index& corner : corners)
        corner = draft.vertices[corner];
}

/// Copies the twins. A pair of half-edges is visited once, at its first half-edge.
void copy_twins(const PolygonMesh& mesh, const Topology& topology, SubMeshDraft& draft)
{
    SubMesh& sub_mesh = draft.sub_mesh;
    sub_mesh.twin.assign(sub_mesh.face_vertices.values.size(), -1);
    Index own_halfedge = 0;
    for (const Index f : sub_mesh.faces)
        for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h, ++own_halfedge) {
            const Index twin = topology.twin[h];
            if (twin < h)
                continue;
            const Index other_face = topology.face_of[twin];
            const Index face = draft.faces[other_face];
            if (face < 0)
                continue;
            const Index other = sub_mesh.face_vertices.offsets[face] + twin - mesh.face_offsets[other_face];
            sub_mesh.twin[own_halfedge] = other;
            sub_mesh.twin[other] = own_halfedge;
        }
}

/// Sets SubMesh::fixed.
void mark_fixed(const Topology& topology, SubMesh& sub_mesh)
{
    sub_mesh.fixed.reserve(sub_mesh.local_to_global.size());
    for (const Index v : sub_mesh.local_to_global)
        sub_mesh.fixed.push_back(topology.moves(v) ? 0 : 1);
}

}  // namespace

bool is_on_interface(const Topology& topology, std::span<const Index> labels, Index v)
{
    return topology.moves(v) && is_mixed(topology, labels, v);
}

SubMeshDraft copy_faces(const PolygonMesh& mesh, const Topology& topology, std::vector<Index> faces)
{
    // Made before the aggregate: if memory runs out for a later member, GCC 12 destroys members made from {} twice.
    IndexSet of_faces(faces);
    SubMeshDraft draft{.sub_mesh = {}, .vertices = {}, .halo = {}, .faces = std::move(of_faces)};
    draft.sub_mesh.faces = std::move(faces);
    copy_vertices(mesh, draft);
    copy_twins(mesh, topology, draft);
    mark_fixed(topology, draft.sub_mesh);
    return draft;
}

void append_halo(std::span<const Index> vertices, SubMeshDraft& draft)
{
    std::vector<Index> others;
    std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(others),
                 [&](Index v) { return draft.vertices[v] < 0; });
    draft.halo = IndexSet(others);
    const std::vector<Index>& halo = draft.halo.ascending();
    auto& local_to_global = draft.sub_mesh.local_to_global;
    local_to_global.reserve(local_to_global.size() + halo.size());
    local_to_global.insert(local_to_global.end(), halo.begin(), halo.end());
    draft.sub_mesh.n_halo = static_cast<Index>(halo.size());
}

void append_corrected(Index v, std::span<const Index> neighbours, SubMeshDraft& draft)
{
    auto& corrected = draft.sub_mesh.corrected;
    corrected.vertices.push_back(draft.local(v));
    for (const Index neighbour : neighbours)
        corrected.neighbours.values.push_back(draft.local(neighbour));
    corrected.neighbours.close();
}

void list_sharing(const Topology& topology, std::span<const Index> labels, std::span<const SubMesh> sub_meshes,
                  SubMeshInterface& interface, std::span<const Index> local_to_global)
{
    std::vector<Index> around;
    for (const Index i : interface.vertices) {
        const Index v = local_to_global[i];
        labels_around(topology, labels, v, around);
        for (const Index label : around) {
            interface.sharing.values.push_back(label);
            interface.index_in_sharing.values.push_back(local_index(sub_meshes[label], v));
        }
        interface.sharing.close();
        interface.index_in_sharing.close();
    }
}

}  // namespace seamflow
