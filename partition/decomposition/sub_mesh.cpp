#include "partition/decomposition/sub_mesh.h"

#include <algorithm>
#include <cassert>

namespace seamflow {

namespace {

void sort_unique(std::vector<Index>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Position of `value` in the ascending range, or -1.
Index position_in(std::span<const Index> ascending, Index value)
{
    const auto found = std::lower_bound(ascending.begin(), ascending.end(), value);
    return found != ascending.end() && *found == value ? static_cast<Index>(found - ascending.begin()) : -1;
}

void list_own_vertices(const PolygonMesh& mesh, SubMesh& sub_mesh)
{
    for (const Index f : sub_mesh.faces)
        sub_mesh.local_to_global.insert(sub_mesh.local_to_global.end(), mesh.face(f).begin(), mesh.face(f).end());
    sort_unique(sub_mesh.local_to_global);
    sub_mesh.n_vertices = static_cast<Index>(sub_mesh.local_to_global.size());
}

void localise_faces(const PolygonMesh& mesh, SubMesh& sub_mesh)
{
    for (const Index f : sub_mesh.faces) {
        for (const Index v : mesh.face(f))
            sub_mesh.face_vertices.values.push_back(local_index(sub_mesh, v));
        sub_mesh.face_vertices.close();
    }
}

void localise_twins(const PolygonMesh& mesh, const Topology& topology, SubMesh& sub_mesh)
{
    sub_mesh.twin.reserve(sub_mesh.face_vertices.values.size());
    for (const Index f : sub_mesh.faces)
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            const Index face = twin < 0 ? -1 : position_in(sub_mesh.faces, topology.face_of[at(twin)]);
            sub_mesh.twin.push_back(face < 0 ? -1
                                             : sub_mesh.face_vertices.offsets[at(face)] + twin -
                                                   mesh.face_offsets[at(topology.face_of[at(twin)])]);
        }
}

bool is_on_interface(const Topology& topology, std::span<const Index> labels, Index v)
{
    if (topology.kind[at(v)] != VertexKind::Interior)
        return false;
    const auto corners = topology.corners_at(v);
    const auto label_of = [&](Index corner) { return labels[at(topology.face_of[at(corner)])]; };
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index corner) { return label_of(corner) != label_of(corners.front()); });
}

void classify_vertices(const Topology& topology, std::span<const Index> labels, SubMesh& sub_mesh)
{
    sub_mesh.fixed.resize(at(sub_mesh.n_vertices));
    sub_mesh.owned.resize(at(sub_mesh.n_vertices));
    for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
        const Index v = sub_mesh.local_to_global[at(i)];
        const bool moves = topology.kind[at(v)] == VertexKind::Interior;
        const Index lowest_label = [&] {
            Index lowest = labels[at(sub_mesh.faces.front())];
            for (const Index corner : topology.corners_at(v))
                lowest = std::min(lowest, labels[at(topology.face_of[at(corner)])]);
            return lowest;
        }();
        sub_mesh.fixed[at(i)] = moves ? 0 : 1;
        sub_mesh.owned[at(i)] = moves && lowest_label == labels[at(sub_mesh.faces.front())] ? 1 : 0;
        if (is_on_interface(topology, labels, v))
            sub_mesh.interface.vertices.push_back(i);
    }
}

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

/// Appends the halo's vertices to the sub-mesh's own.
void list_halo_vertices(const PolygonMesh& mesh, std::span<const Index> halo_faces, SubMesh& sub_mesh)
{
    std::vector<Index> halo;
    for (const Index f : halo_faces)
        for (const Index v : mesh.face(f))
            if (local_index(sub_mesh, v) < 0)
                halo.push_back(v);
    sort_unique(halo);
    sub_mesh.n_halo = static_cast<Index>(halo.size());
    sub_mesh.local_to_global.insert(sub_mesh.local_to_global.end(), halo.begin(), halo.end());
}

/// The local index of a vertex of the sub-mesh or of its halo.
Index local_or_halo_index(const SubMesh& sub_mesh, Index v)
{
    const Index own = local_index(sub_mesh, v);
    if (own >= 0)
        return own;
    const auto halo = std::span<const Index>(sub_mesh.local_to_global).subspan(at(sub_mesh.n_vertices));
    return sub_mesh.n_vertices + position_in(halo, v);
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

/// The vertices at the other ends of the edges at v, in ascending order.
std::vector<Index> edge_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    std::vector<Index> neighbours;
    for (const Index corner : topology.corners_at(v)) {
        neighbours.push_back(mesh.face_vertices[at(topology.next(mesh, corner))]);
        neighbours.push_back(mesh.face_vertices[at(topology.previous(mesh, corner))]);
    }
    sort_unique(neighbours);
    return neighbours;
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
    for (const Index neighbour : edge_neighbours(mesh, topology, v))
        interface.neighbours.values.push_back(local_or_halo_index(sub_mesh, neighbour));
    interface.own_faces.close();
    interface.complement_faces.close();
    interface.neighbours.close();
}

}  // namespace

Index local_index(const SubMesh& sub_mesh, Index global_vertex)
{
    return position_in(std::span<const Index>(sub_mesh.local_to_global).first(at(sub_mesh.n_vertices)), global_vertex);
}

SubMesh make_sub_mesh(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                      std::vector<Index> faces)
{
    SubMesh sub_mesh;
    sub_mesh.faces = std::move(faces);
    list_own_vertices(mesh, sub_mesh);
    localise_faces(mesh, sub_mesh);
    localise_twins(mesh, topology, sub_mesh);
    classify_vertices(topology, labels, sub_mesh);
    const auto halo_faces = list_halo_faces(topology, labels, sub_mesh);
    list_halo_vertices(mesh, halo_faces, sub_mesh);
    localise_halo_faces(mesh, halo_faces, sub_mesh);
    for (const Index i : sub_mesh.interface.vertices)
        describe_interface_vertex(mesh, topology, labels, halo_faces, sub_mesh.local_to_global[at(i)], sub_mesh);
    return sub_mesh;
}

}  // namespace seamflow
