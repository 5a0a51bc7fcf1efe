#include "partition/decomposition/decomposition.h"

#include <algorithm>
#include <map>

#include "partition/decomposition/local_mesh.h"

namespace seamflow {

namespace {

void list_sharing(const Topology& topology, std::span<const Index> labels, Index s, Decomposition& decomposition)
{
    SubMesh& sub_mesh = decomposition.sub_meshes[at(s)];
    auto& interface = sub_mesh.interface;
    auto& adjacent = decomposition.adjacency[at(s)];
    for (const Index i : interface.vertices) {
        const Index v = sub_mesh.local_to_global[at(i)];
        for (const Index t : labels_at(topology, labels, v)) {
            interface.sharing.values.push_back(t);
            interface.index_in_sharing.values.push_back(local_index(decomposition.sub_meshes[at(t)], v));
            if (t != s)
                adjacent.push_back(t);
        }
        interface.sharing.close();
        interface.index_in_sharing.close();
    }
    std::sort(adjacent.begin(), adjacent.end());
    adjacent.erase(std::unique(adjacent.begin(), adjacent.end()), adjacent.end());
}

/// For every vertex of the halo, the lowest of the adjacent sub-meshes that have it; these are the ones that send it.
std::vector<Transfer> list_halo_transfers(const Topology& topology, std::span<const Index> labels, Index s,
                                          const Decomposition& decomposition)
{
    const SubMesh& sub_mesh = decomposition.sub_meshes[at(s)];
    const auto& adjacent = decomposition.adjacency[at(s)];
    std::map<Index, Transfer> by_sender;
    for (Index i = sub_mesh.n_vertices; i < sub_mesh.n_vertices + sub_mesh.n_halo; ++i) {
        const Index v = sub_mesh.local_to_global[at(i)];
        for (const Index t : labels_at(topology, labels, v)) {
            if (!std::binary_search(adjacent.begin(), adjacent.end(), t))
                continue;
            Transfer& transfer = by_sender[t];
            transfer.source.push_back(local_index(decomposition.sub_meshes[at(t)], v));
            transfer.target.push_back(i);
            break;
        }
    }
    std::vector<Transfer> transfers;
    for (auto& [sender, transfer] : by_sender) {
        transfer.from = sender;
        transfer.to = s;
        transfers.push_back(std::move(transfer));
    }
    return transfers;
}

}  // namespace

std::vector<std::vector<Index>> faces_by_label(std::span<const Index> labels, Index n_parts)
{
    std::vector<std::size_t> counts(at(n_parts), 0);
    for (const Index label : labels)
        ++counts[at(label)];
    std::vector<std::vector<Index>> faces(at(n_parts));
    for (std::size_t s = 0; s < faces.size(); ++s)
        faces[s].reserve(counts[s]);
    for (std::size_t f = 0; f < labels.size(); ++f)
        faces[at(labels[f])].push_back(static_cast<Index>(f));
    return faces;
}

Decomposition connect(std::vector<SubMesh> sub_meshes, const Topology& topology, std::span<const Index> labels,
                      const Loop& loop)
{
    Decomposition decomposition;
    decomposition.sub_meshes = std::move(sub_meshes);
    const auto n = static_cast<Index>(decomposition.sub_meshes.size());
    decomposition.adjacency.resize(at(n));
    decomposition.halo.resize(at(n));
    for_each(loop, n, [&](Index s) { list_sharing(topology, labels, s, decomposition); });
    for_each(loop, n,
             [&](Index s) { decomposition.halo[at(s)] = list_halo_transfers(topology, labels, s, decomposition); });
    for (const SubMesh& sub_mesh : decomposition.sub_meshes)
        for (const Index i : sub_mesh.interface.vertices)
            decomposition.n_interface_vertices += sub_mesh.owned[at(i)];
    return decomposition;
}

Decomposition decompose(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts,
                        const Loop& loop)
{
    auto faces = faces_by_label(labels, n_parts);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(loop, n_parts,
             [&](Index s) { sub_meshes[at(s)] = make_sub_mesh(mesh, topology, labels, std::move(faces[at(s)])); });
    return connect(std::move(sub_meshes), topology, labels, loop);
}

}  // namespace seamflow
