#include "partition/decomposition/sub_mesh.h"

#include <cassert>

#include "partition/decomposition/local_mesh.h"

namespace seamflow {

namespace {

/// The faces of other sub-meshes that touch Γ, as indices into the whole mesh.
std::vector<Index> list_halo_faces(const Topology& topology, std::span<const Index> labels, const SubMesh& sub_mesh)
{
    const Index label = labels[at(sub_mesh.faces.front())];
    std::vector<Index> faces;
    for (const Index i : sub_mesh.interface.vertices)
        for (const Index corner : topology.corners_at(sub_mesh.local_to_global[at(i)]))
            if (const Index f = topology.face_of[at(corner)]; labels[at(f)] != label)
                faces.push_back(f);
    sort_unique(faces);
    return faces;
}

std::vector<Index> vertices_of(const PolygonMesh& mesh, std::span<const Index> faces)
{
    std::vector<Index> vertices;
    for (const Index f : faces)
        vertices.insert(vertices.end(), mesh.face(f).begin(), mesh.face(f).end());
    return vertices;
}

void localise_halo_faces(const PolygonMesh& mesh, std::span<const Index> halo_faces, SubMesh& sub_mesh)
{
    auto& lists = sub_mesh.interface.halo_faces;
    for (const Index f : halo_faces) {
        for (const Index v : mesh.face(f))
            lists.values.push_back(local_or_halo_index(sub_mesh, v));
        lists.close();
    }
}

/// Fans and neighbours at one vertex of Γ.
void describe_interface_vertex(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                               std::span<const Index> halo_faces, Index v, SubMesh& sub_mesh)
{
    auto& interface = sub_mesh.interface;
    const auto fans = fans_at(mesh, topology, v, labels, labels[at(sub_mesh.faces.front())]);
    assert(fans.size() == 1 && !fans.front().closed && "a repaired cut has one fan of each part around each vertex");
    interface.before.push_back(local_index(sub_mesh, fans.front().first));
    interface.after.push_back(local_index(sub_mesh, fans.front().last));
    for (const Index corner : topology.corners_at(v)) {
        const Index f = topology.face_of[at(corner)];
        if (const Index own = position_in(sub_mesh.faces, f); own >= 0)
            interface.own_faces.values.push_back(own);
        else
            interface.complement_faces.values.push_back(position_in(halo_faces, f));
    }
    interface.own_faces.close();
    interface.complement_faces.close();
    append_to_seam(mesh, topology, v, sub_mesh);
}

}  // namespace

Index local_index(const SubMesh& sub_mesh, Index global_vertex)
{
    return position_in(std::span<const Index>(sub_mesh.local_to_global).first(at(sub_mesh.n_vertices)), global_vertex);
}

SubMesh make_sub_mesh(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                      std::vector<Index> faces)
{
    const Index own = labels[at(faces.front())];
    SubMesh sub_mesh = copy_faces(mesh, topology, std::move(faces));
    mark_owned(topology, labels, own, sub_mesh);
    for (Index i = 0; i < sub_mesh.n_vertices; ++i)
        if (is_on_interface(topology, labels, sub_mesh.local_to_global[at(i)]))
            sub_mesh.interface.vertices.push_back(i);
    const auto halo_faces = list_halo_faces(topology, labels, sub_mesh);
    append_halo(vertices_of(mesh, halo_faces), sub_mesh);
    localise_halo_faces(mesh, halo_faces, sub_mesh);
    for (const Index i : sub_mesh.interface.vertices)
        describe_interface_vertex(mesh, topology, labels, halo_faces, sub_mesh.local_to_global[at(i)], sub_mesh);
    return sub_mesh;
}

}  // namespace seamflow
