#include "partition/decomposition/decomposition.h"

#include <algorithm>

#include "partition/decomposition/local_mesh.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// Where a movable vertex is: all its copies on Γ, and the one of the sub-mesh that speaks for it everywhere.
class Copies {
  public:
    Copies(const std::vector<SubMesh>& sub_meshes, Index n_vertices, const Loop& loop);

    /// Number of vertices on Γ.
    [[nodiscard]] Index n_interface_vertices() const { return sub_meshes_.size(); }

    [[nodiscard]] bool is_on_interface(Index v) const { return number_[v] >= 0; }

    /// The sub-meshes at a vertex of Γ, ascending, and its local index in each.
    [[nodiscard]] std::span<const Index> sub_meshes(Index v) const { return sub_meshes_[number_[v]]; }
    [[nodiscard]] std::span<const Index> local_indices(Index v) const { return local_indices_[number_[v]]; }

    /// The local index in the sub-mesh that owns v, which must be movable.
    [[nodiscard]] Index owned_index(Index v) const { return owned_index_[v]; }

  private:
    /// #V: the position on Γ, or -1.
    std::vector<Index> number_;
    IndexLists sub_meshes_;
    IndexLists local_indices_;
    std::vector<Index> owned_index_;
};

Copies::Copies(const std::vector<SubMesh>& sub_meshes, Index n_vertices, const Loop& loop)
{
    for_each(loop, 2, [&](Index one_of_both) { (one_of_both == 0 ? number_ : owned_index_).assign(n_vertices, -1); });
    for_each(loop, static_cast<Index>(sub_meshes.size()), [&](Index s) {
        const SubMesh& sub_mesh = sub_meshes[s];
        for (Index i = 0; i < sub_mesh.n_vertices; ++i)
            if (sub_mesh.owned[i] != 0)
                owned_index_[sub_mesh.local_to_global[i]] = i;
    });
    const auto for_each_copy = [&](const auto& visit) {
        for (std::size_t s = 0; s < sub_meshes.size(); ++s)
            for (const Index i : sub_meshes[s].interface.vertices)
                visit(static_cast<Index>(s), i, number_[sub_meshes[s].local_to_global[i]]);
    };
    std::vector<Index> counts;
    for_each_copy([&](Index, Index, Index& number) {
        if (number < 0) {
            number = static_cast<Index>(counts.size());
            counts.push_back(0);
        }
        ++counts[number];
    });
    for (const Index count : counts)
        sub_meshes_.offsets.push_back(sub_meshes_.offsets.back() + count);
    std::vector<Index> next(sub_meshes_.offsets.begin(), sub_meshes_.offsets.end() - 1);
    local_indices_.offsets = sub_meshes_.offsets;
    sub_meshes_.values.resize(sub_meshes_.offsets.back());
    local_indices_.values.resize(sub_meshes_.values.size());
    for_each_copy([&](Index s, Index i, Index number) {
        sub_meshes_.values[next[number]] = s;
        local_indices_.values[next[number]++] = i;
    });
}

void list_sharing(const Copies& copies, Index s, Decomposition& decomposition)
{
    SubMesh& sub_mesh = decomposition.sub_meshes[s];
    auto& interface = sub_mesh.interface;
    auto& adjacent = decomposition.adjacency[s];
    for (const Index i : interface.vertices) {
        const Index v = sub_mesh.local_to_global[i];
        const auto sharing = copies.sub_meshes(v);
        const auto indices = copies.local_indices(v);
        interface.sharing.values.insert(interface.sharing.values.end(), sharing.begin(), sharing.end());
        interface.index_in_sharing.values.insert(interface.index_in_sharing.values.end(), indices.begin(),
                                                 indices.end());
        interface.sharing.close();
        interface.index_in_sharing.close();
    }
    adjacent = interface.sharing.values;
    sort_unique(adjacent);
    std::erase(adjacent, s);
    adjacent.shrink_to_fit();
}

/// For every vertex of the halo, the lowest of the adjacent sub-meshes that have it; these are the ones that send it.
std::vector<Transfer> list_halo_transfers(const Topology& topology, std::span<const Index> labels, const Copies& copies,
                                          Index s, const Decomposition& decomposition)
{
    const SubMesh& sub_mesh = decomposition.sub_meshes[s];
    const auto& adjacent = decomposition.adjacency[s];
    const auto is_adjacent = [&](Index t) { return std::binary_search(adjacent.begin(), adjacent.end(), t); };
    std::vector<TransferRow> rows;
    rows.reserve(sub_mesh.n_halo);
    std::vector<Index> around;
    for (Index i = sub_mesh.n_vertices; i < sub_mesh.n_vertices + sub_mesh.n_halo; ++i) {
        const Index v = sub_mesh.local_to_global[i];
        if (copies.is_on_interface(v)) {
            const auto sharing = copies.sub_meshes(v);
            const auto sender = std::find_if(sharing.begin(), sharing.end(), is_adjacent);
            rows.push_back({*sender, copies.local_indices(v)[static_cast<std::size_t>(sender - sharing.begin())], i});
        } else if (copies.owned_index(v) >= 0) {
            rows.push_back({labels[topology.face_of[topology.corners_at(v).front()]], copies.owned_index(v), i});
        } else {
            labels_around(topology, labels, v, around);
            const auto sender = std::find_if(around.begin(), around.end(), is_adjacent);
            rows.push_back({*sender, local_index(decomposition.sub_meshes[*sender], v), i});
        }
    }
    return transfers_to(s, std::move(rows));
}

/// The faces of a range by their labels, in ascending order for each.
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

std::vector<std::vector<Index>> faces_by_label(std::span<const Index> labels, Index n_parts, const Loop& loop)
{
    const std::vector<IndexRange> ranges = long_ranges(static_cast<Index>(labels.size()), n_parts);
    std::vector<IndexLists> of_range(ranges.size());
    for_each(loop, static_cast<Index>(ranges.size()),
             [&](Index r) { of_range[r] = sorted_by_label(labels, n_parts, ranges[r]); });
    std::vector<std::vector<Index>> faces(n_parts);
    for_each(loop, n_parts, [&](Index s) {
        std::size_t count = 0;
        for (const IndexLists& lists : of_range)
            count += lists[s].size();
        faces[s].reserve(count);
        for (const IndexLists& lists : of_range)
            faces[s].insert(faces[s].end(), lists[s].begin(), lists[s].end());
    });
    return faces;
}

Decomposition connect(std::vector<SubMesh> sub_meshes, const Topology& topology, std::span<const Index> labels,
                      const Loop& loop)
{
    Decomposition decomposition;
    decomposition.sub_meshes = std::move(sub_meshes);
    const auto n = static_cast<Index>(decomposition.sub_meshes.size());
    const Copies copies(decomposition.sub_meshes, static_cast<Index>(topology.kind.size()), loop);
    decomposition.n_interface_vertices = copies.n_interface_vertices();
    decomposition.adjacency.resize(n);
    decomposition.halo.resize(n);
    for_each(loop, n, [&](Index s) {
        list_sharing(copies, s, decomposition);
        decomposition.halo[s] = list_halo_transfers(topology, labels, copies, s, decomposition);
    });
    return decomposition;
}

Decomposition decompose(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts,
                        const Loop& loop)
{
    auto faces = faces_by_label(labels, n_parts, loop);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(loop, n_parts,
             [&](Index s) { sub_meshes[s] = make_sub_mesh(mesh, topology, labels, std::move(faces[s])); });
    return connect(std::move(sub_meshes), topology, labels, loop);
}

}  // namespace seamflow
