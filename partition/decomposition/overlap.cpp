#include "partition/decomposition/overlap.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "partition/decomposition/local_mesh.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// Whether v may move and has faces outside the sub-mesh.
bool is_artificial_boundary(const Topology& topology, const SubMesh& sub_mesh, Index v)
{
    const auto corners = topology.corners_at(v);
    return topology.moves(v) && std::any_of(corners.begin(), corners.end(),
                                            [&](Index c) { return find_in(sub_mesh.faces, topology.face_of[c]) < 0; });
}

/// Fills in the interface of a sub-mesh (see make_overlapping_sub_mesh).
void list_artificial_boundary(const Topology& topology, SubMesh& sub_mesh)
{
    auto& interface = sub_mesh.interface;
    for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
        if (!is_artificial_boundary(topology, sub_mesh, sub_mesh.local_to_global[i]))
            continue;
        interface.vertices.push_back(i);
        interface.before.push_back(-1);
        interface.after.push_back(-1);
        interface.own_faces.close();
        interface.complement_faces.close();
    }
}

/// The vertices of these faces for which `holds` is true, by their numbers in the whole mesh, ascending.
template <class Predicate>
std::vector<Index> vertices_of(const PolygonMesh& mesh, std::span<const Index> faces, Predicate&& holds)
{
    std::vector<Index> vertices;
    for (const Index f : faces)
        std::copy_if(mesh.face(f).begin(), mesh.face(f).end(), std::back_inserter(vertices), holds);
    sort_unique(vertices);
    return vertices;
}

/// Marks the vertices that a sub-mesh owns: those that may move and whose lowest label is the sub-mesh's own.
void mark_owned(const Topology& topology, std::span<const Index> labels, Index own, SubMesh& sub_mesh)
{
    sub_mesh.owned.resize(sub_mesh.n_vertices);
    std::vector<Index> parts;
    for (Index i = 0; i < sub_mesh.n_vertices; ++i) {
        labels_around(topology, labels, sub_mesh.local_to_global[i], parts);
        sub_mesh.owned[i] = sub_mesh.fixed[i] == 0 && parts.front() == own ? 1 : 0;
    }
}

/// The transfers into part s: every vertex outside the ungrown part is sent by the lowest part that has it before
/// growing.
std::vector<Transfer> list_halo_transfers(const Topology& topology, const Overlap& overlap, Index s,
                                          std::span<const SubMesh> sub_meshes)
{
    const auto& local_to_global = sub_meshes[s].local_to_global;
    std::vector<TransferRow> rows;
    std::vector<Index> parts;
    for (std::size_t i = 0; i < local_to_global.size(); ++i) {
        labels_around(topology, overlap.labels, local_to_global[i], parts);
        if (!std::binary_search(parts.begin(), parts.end(), s))
            rows.push_back(
                {parts.front(), local_index(sub_meshes[parts.front()], local_to_global[i]), static_cast<Index>(i)});
    }
    return transfers_to(s, std::move(rows));
}

/// Sets Decomposition::adjacency: parts are adjacent if there is a transfer between them.
void list_adjacent(Decomposition& decomposition)
{
    decomposition.adjacency.resize(decomposition.halo.size());
    for (const auto& transfers : decomposition.halo)
        for (const Transfer& transfer : transfers) {
            decomposition.adjacency[transfer.from].push_back(transfer.to);
            decomposition.adjacency[transfer.to].push_back(transfer.from);
        }
    for (auto& adjacent : decomposition.adjacency)
        sort_unique(adjacent);
}

}  // namespace

SubMesh make_overlapping_sub_mesh(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                                  std::vector<Index> faces)
{
    const std::vector<Index> corrected =
        vertices_of(mesh, faces, [&](Index v) { return is_on_interface(topology, overlap.labels, v); });
    SubMeshDraft draft = copy_faces(mesh, topology, grow(mesh, topology, overlap, s, std::move(faces)));
    mark_owned(topology, overlap.labels, s, draft.sub_mesh);
    list_artificial_boundary(topology, draft.sub_mesh);
    std::vector<Index> around_corrected;
    std::vector<Index> neighbours;
    for (const Index v : corrected) {
        edge_neighbours(mesh, topology, v, neighbours);
        around_corrected.insert(around_corrected.end(), neighbours.begin(), neighbours.end());
    }
    append_halo(around_corrected, draft);
    for (const Index v : corrected) {
        edge_neighbours(mesh, topology, v, neighbours);
        append_corrected(v, neighbours, draft);
    }
    return std::move(draft.sub_mesh);
}

Decomposition connect_overlapping(std::vector<SubMesh> sub_meshes, const Topology& topology, const Overlap& overlap)
{
    Decomposition decomposition;
    for (Index s = 0; s < static_cast<Index>(sub_meshes.size()); ++s) {
        SubMesh& sub_mesh = sub_meshes[s];
        list_sharing(topology, overlap.labels, sub_meshes, sub_mesh.interface, sub_mesh.local_to_global);
        decomposition.halo.push_back(list_halo_transfers(topology, overlap, s, sub_meshes));
        for (const Index v : sub_mesh.corrected.vertices)
            decomposition.n_interface_vertices += sub_mesh.owned[v];
    }
    decomposition.sub_meshes = std::move(sub_meshes);
    list_adjacent(decomposition);
    return decomposition;
}

}  // namespace seamflow
