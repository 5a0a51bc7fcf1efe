#include "partition/decomposition/decomposition.h"

#include <algorithm>
#include <utility>

#include "partition/decomposition/local_mesh.h"
#include "partition/decomposition/make_sub_mesh.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// The transfers into the halo of sub-mesh s: every vertex of the halo is sent by the lowest of the adjacent sub-meshes
/// that have it.
std::vector<Transfer> list_halo_transfers(const Topology& topology, std::span<const Index> labels, Index s,
                                          const Decomposition& decomposition)
{
    const SubMesh& sub_mesh = decomposition.sub_meshes[s];
    const auto& adjacent = decomposition.adjacency[s];
    const auto is_adjacent = [&](Index t) { return std::binary_search(adjacent.begin(), adjacent.end(), t); };
    std::vector<TransferRow> rows;
    rows.reserve(sub_mesh.n_halo);
    std::vector<Index> around;
    for (Index i = sub_mesh.n_vertices; i < sub_mesh.n_vertices + sub_mesh.n_halo; ++i) {
        const Index v = sub_mesh.local_to_global[i];
        labels_around(topology, labels, v, around);
        const Index sender = *std::ranges::find_if(around, is_adjacent);
        rows.push_back({sender, local_index(decomposition.sub_meshes[sender], v), i});
    }
    return transfers_to(s, std::move(rows));
}

/// Sorts the faces of a range by their labels; ascending for each label.
IndexLists sorted_by_label(std::span<const Index> labels, Index n_parts, IndexRange range)
{
    return make_lists(n_parts, [&](auto&& add) {
        for (Index f = range.begin; f < range.end; ++f)
            add(labels[f], f);
    });
}

}  // namespace

std::vector<Transfer> transfers_to(Index to, std::vector<TransferRow> rows)
{
    std::ranges::stable_sort(rows, {}, &TransferRow::from);
    std::vector<Transfer> transfers;
    for (auto row = rows.begin(); row != rows.end();) {
        Transfer& transfer = transfers.emplace_back();
        const auto end = std::ranges::upper_bound(row, rows.end(), row->from, {}, &TransferRow::from);
        transfer.from = row->from;
        transfer.to = to;
        transfer.source.reserve(static_cast<std::size_t>(end - row));
        transfer.target.reserve(static_cast<std::size_t>(end - row));
        for (; row != end; ++row) {
            transfer.source.push_back(row->source);
            transfer.target.push_back(row->target);
        }
    }
    return transfers;
}

std::vector<std::vector<Index>> faces_by_label(std::span<const Index> labels, Index n_parts, const Executor& exec)
{
    const std::vector<IndexRange> ranges = long_ranges(static_cast<Index>(labels.size()), n_parts);
    std::vector<IndexLists> of_range(ranges.size());
    for_each(exec, static_cast<Index>(ranges.size()),
             [&](Index r) { of_range[r] = sorted_by_label(labels, n_parts, ranges[r]); });
    std::vector<std::vector<Index>> faces(n_parts);
    for_each(exec, n_parts, [&](Index s) {
        std::size_t count = 0;
        for (const IndexLists& lists : of_range)
            count += lists[s].size();
        faces[s].reserve(count);
        for (const IndexLists& lists : of_range)
            faces[s].insert(faces[s].end(), lists[s].begin(), lists[s].end());
    });
    return faces;
}

std::vector<Index> labels_by_face(const Decomposition& decomposition, Index n_faces)
{
    std::vector<Index> labels(usize(n_faces));
    for (std::size_t s = 0; s < decomposition.sub_meshes.size(); ++s)
        for (const Index f : decomposition.sub_meshes[s].faces)
            labels[f] = static_cast<Index>(s);
    return labels;
}

Decomposition connect(std::vector<SubMesh> sub_meshes, const Topology& topology, std::span<const Index> labels,
                      const Executor& exec)
{
    Decomposition decomposition;
    decomposition.sub_meshes = std::move(sub_meshes);
    const auto n = static_cast<Index>(decomposition.sub_meshes.size());
    decomposition.adjacency.resize(n);
    decomposition.halo.resize(n);
    for (const SubMesh& sub_mesh : decomposition.sub_meshes)
        for (const Index i : sub_mesh.interface.vertices)
            decomposition.n_interface_vertices += sub_mesh.owned[i];
    for_each(exec, n, [&](Index s) {
        SubMesh& sub_mesh = decomposition.sub_meshes[s];
        list_sharing(topology, labels, decomposition.sub_meshes, sub_mesh.interface, sub_mesh.local_to_global);
        auto& adjacent = decomposition.adjacency[s];
        adjacent = sub_mesh.interface.sharing.values;
        sort_unique(adjacent);
        std::erase(adjacent, s);
        adjacent.shrink_to_fit();
        decomposition.halo[s] = list_halo_transfers(topology, labels, s, decomposition);
    });
    return decomposition;
}

Decomposition decompose(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts,
                        const Executor& exec)
{
    auto faces = faces_by_label(labels, n_parts, exec);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(exec, n_parts,
             [&](Index s) { sub_meshes[s] = make_sub_mesh(mesh, topology, labels, std::move(faces[s])); });
    return connect(std::move(sub_meshes), topology, labels, exec);
}

}  // namespace seamflow
