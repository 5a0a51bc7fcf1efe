#include "partition/decomposition/make_sub_mesh.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "partition/decomposition/local_mesh.h"

namespace seamflow {

namespace {

// The terms of this file (see SubMesh): Γ are the vertices of a sub-mesh that it shares with others and that may move.
// A fan is a run of faces around a vertex, each sharing an edge with the next. The halo are the vertices of other
// sub-meshes' faces that touch Γ.

/// The mesh from which one sub-mesh is cut out.
struct Whole {
    const PolygonMesh& mesh;
    const Topology& topology;
    std::span<const Index> labels;
    /// The label of the sub-mesh.
    Index own;

    [[nodiscard]] Index label_of(Index corner) const { return labels[topology.face_of[corner]]; }
};

/// The sub-mesh's vertices, by their local numbers, that also have faces of other sub-meshes.
std::vector<Index> list_shared(const Topology& topology, const SubMesh& sub_mesh)
{
    std::vector<Index> n_others(sub_mesh.n_vertices);
    for (std::size_t i = 0; i < n_others.size(); ++i)
        n_others[i] = static_cast<Index>(topology.corners_at(sub_mesh.local_to_global[i]).size());
    for (const Index i : sub_mesh.face_vertices.values)
        --n_others[i];
    std::vector<Index> shared;
    for (Index i = 0; i < sub_mesh.n_vertices; ++i)
        if (n_others[i] > 0)
            shared.push_back(i);
    return shared;
}

/// Marks the vertices that the sub-mesh owns. A vertex that may move is owned by the sub-mesh of the lowest label among
/// its faces.
void mark_owned(const Whole& whole, std::span<const Index> shared, SubMesh& sub_mesh)
{
    sub_mesh.owned.resize(sub_mesh.n_vertices);
    for (std::size_t i = 0; i < sub_mesh.owned.size(); ++i)
        sub_mesh.owned[i] = sub_mesh.fixed[i] == 0 ? 1 : 0;
    for (const Index i : shared) {
        const auto corners = whole.topology.corners_at(sub_mesh.local_to_global[i]);
        if (std::any_of(corners.begin(), corners.end(), [&](Index c) { return whole.label_of(c) < whole.own; }))
            sub_mesh.owned[i] = 0;
    }
}

/// The faces of other sub-meshes that touch Γ, by their numbers in the whole mesh.
IndexSet list_halo_faces(const Whole& whole, const SubMesh& sub_mesh)
{
    std::vector<Index> faces;
    for (const Index i : sub_mesh.interface.vertices)
        for (const Index corner : whole.topology.corners_at(sub_mesh.local_to_global[i]))
            if (const Index f = whole.topology.face_of[corner]; whole.labels[f] != whole.own)
                faces.push_back(f);
    return IndexSet(faces);
}

/// Makes the other vertices of the halo faces the halo, and lists these faces in local numbers.
void localise_halo_faces(const PolygonMesh& mesh, std::span<const Index> halo_faces, SubMeshDraft& draft)
{
    auto& lists = draft.sub_mesh.interface.halo_faces;
    std::vector<Index> vertices;
    for (const Index f : halo_faces)
        vertices.insert(vertices.end(), mesh.face(f).begin(), mesh.face(f).end());
    append_halo(vertices, draft);
    for (const Index f : halo_faces) {
        for (const Index v : mesh.face(f))
            lists.values.push_back(draft.local(v));
        lists.close();
    }
}

/// Fills in the faces on both sides of Γ at one of its vertices, and its neighbours along the boundary of the sub-mesh.
/// Appends the vertex to SubMesh::corrected, the vertices that move to the centroids of their edge neighbours after a
/// step, to correct errors on Γ.
/// @param v the vertex, by its number in the whole mesh. @param neighbours scratch.
void describe_interface_vertex(const Whole& whole, const IndexSet& halo_faces, Index v, std::vector<Index>& neighbours,
                               SubMeshDraft& draft)
{
    auto& interface = draft.sub_mesh.interface;
    const auto corners = whole.topology.corners_at(v);
    const auto lowest_own =
        std::find_if(corners.begin(), corners.end(), [&](Index c) { return whole.label_of(c) == whole.own; });
    assert((whole.topology.kind[v] != VertexKind::Interior ||
            fans_at(whole.mesh, whole.topology, v, whole.labels, whole.own).size() == 1) &&
           "a repaired cut has one fan of each part around each interior vertex");
    const auto [first, last] = ends_of_fan(whole.mesh, whole.topology, *lowest_own, whole.labels);
    interface.before.push_back(draft.vertices[first]);
    interface.after.push_back(draft.vertices[last]);
    for (const Index corner : corners) {
        const Index f = whole.topology.face_of[corner];
        if (whole.labels[f] == whole.own)
            interface.own_faces.values.push_back(draft.faces[f]);
        else
            interface.complement_faces.values.push_back(halo_faces[f]);
    }
    interface.own_faces.close();
    interface.complement_faces.close();
    edge_neighbours(whole.mesh, whole.topology, v, neighbours);
    append_corrected(v, neighbours, draft);
}

}  // namespace

SubMesh make_sub_mesh(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                      std::vector<Index> faces)
{
    const Whole whole{mesh, topology, labels, labels[faces.front()]};
    SubMeshDraft draft = copy_faces(mesh, topology, std::move(faces));
    SubMesh& sub_mesh = draft.sub_mesh;
    const auto shared = list_shared(topology, sub_mesh);
    mark_owned(whole, shared, sub_mesh);
    std::copy_if(shared.begin(), shared.end(), std::back_inserter(sub_mesh.interface.vertices),
                 [&](Index i) { return sub_mesh.fixed[i] == 0; });
    const IndexSet halo_faces = list_halo_faces(whole, sub_mesh);
    localise_halo_faces(mesh, halo_faces.ascending(), draft);
    std::vector<Index> neighbours;
    for (const Index i : sub_mesh.interface.vertices)
        describe_interface_vertex(whole, halo_faces, sub_mesh.local_to_global[i], neighbours, draft);
    auto& interface = sub_mesh.interface;
    for (auto* list : {&interface.vertices, &interface.before, &interface.after, &sub_mesh.corrected.vertices})
        list->shrink_to_fit();
    for (auto* lists :
         {&interface.own_faces, &interface.complement_faces, &interface.halo_faces, &sub_mesh.corrected.neighbours})
        lists->shrink_to_fit();
    return std::move(draft.sub_mesh);
}

void keep_faces_at_interface(SubMesh& sub_mesh)
{
    std::vector<Index>& around = sub_mesh.interface.own_faces.values;
    std::vector<Index> kept = around;
    sort_unique(kept);
    for (Index& f : around)
        f = place_in(kept, f);
    IndexLists faces;
    for (const Index f : kept) {
        const auto corners = sub_mesh.face_vertices[f];
        faces.values.insert(faces.values.end(), corners.begin(), corners.end());
        faces.close();
    }
    faces.shrink_to_fit();
    sub_mesh.face_vertices = std::move(faces);
}

}  // namespace seamflow
