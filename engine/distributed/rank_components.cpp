#include "engine/distributed/rank_components.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace seamflow {

namespace {

/// A vertex of a component, in numbers common to all ranks.
struct Member {
    std::int64_t vertex;
    std::int64_t component;
};

/// Values of a vertex, and its row in a table.
struct TableRow {
    std::int64_t row;
    std::array<double, 3> values;
};

/// The components of a rank's own faces, and which of them may be small and free as far as it knows.
struct OwnComponents {
    Components of_vertices;
    /// Per component: 1 if it may.
    std::vector<std::uint8_t> may;
};

bool is_own_corner(const RankMesh& mesh, Index corner)
{
    return mesh.is_own[mesh.part.labels[mesh.topology.face_of[corner]]] != 0;
}

OwnComponents find_own(const RankMesh& mesh, const Points& positions, double extent)
{
    const auto of_own_faces = [&](Index v, auto&& visit) {
        for (const Index corner : mesh.topology.corners_at(v))
            if (is_own_corner(mesh, corner))
                for (const Index w : mesh.part.mesh.face(mesh.topology.face_of[corner]))
                    visit(w);
    };
    OwnComponents own{.of_vertices = connected_components(mesh.part.mesh.n_vertices(), of_own_faces), .may = {}};
    for (Index c = 0; c < own.of_vertices.count(); ++c) {
        const auto vertices = own.of_vertices.nodes[c];
        const bool is_free = std::ranges::all_of(
            vertices, [&](Index v) { return mesh.topology.moves(v) && !is_weak(mesh.part.strengths, v); });
        own.may.push_back(vertices.size() > 1 && is_free && is_smaller(positions, vertices, extent) ? 1 : 0);
    }
    return own;
}

/// The vertices of some of a rank's components.
/// @param first the number of its first component among those of all ranks.
template <class IsWanted>
std::vector<Member> members(const RankMesh& mesh, const OwnComponents& own, std::int64_t first, IsWanted&& is_wanted)
{
    std::vector<Member> found;
    for (Index v = 0; v < mesh.part.mesh.n_vertices(); ++v)
        if (const Index c = own.of_vertices.component_of[v]; own.of_vertices.nodes[c].size() > 1 && is_wanted(v, c))
            found.push_back({mesh.part.vertex_numbers[v], first + c});
    return found;
}

/// Joins the components of all ranks at shared vertices.
Components join(std::vector<Member> shared, Index n_components)
{
    std::ranges::stable_sort(shared, {}, &Member::vertex);
    const IndexLists neighbours = make_lists(n_components, [&](auto&& enter) {
        for (std::size_t i = 1; i < shared.size(); ++i) {
            if (shared[i].vertex != shared[i - 1].vertex)
                continue;
            const auto one = static_cast<Index>(shared[i - 1].component);
            const auto other = static_cast<Index>(shared[i].component);
            enter(one, other);
            enter(other, one);
        }
    });
    return connected_components(n_components, [&](Index c, auto&& visit) {
        for (const Index other : neighbours[c])
            visit(other);
    });
}

/// Lists components by their lowest vertices, as a single machine does.
void list(std::vector<Member> all, const RankMesh& mesh, SmallComponents& small)
{
    std::ranges::sort(all, [](const Member& a, const Member& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.component < b.component;
    });
    all.erase(
        std::unique(all.begin(), all.end(), [](const Member& a, const Member& b) { return a.vertex == b.vertex; }),
        all.end());
    std::unordered_map<std::int64_t, Index> place;
    for (const Member& member : all)
        place.emplace(member.component, static_cast<Index>(place.size()));
    small.rows = make_lists(static_cast<Index>(place.size()), [&](auto&& enter) {
        for (std::size_t row = 0; row < all.size(); ++row)
            enter(place.at(all[row].component), static_cast<Index>(row));
    });
    const auto& known = mesh.part.vertex_numbers;
    for (const Member& member : all)
        small.vertices.push_back(position_in(known, member.vertex));
}

Points gather_table(Communicator& comm, const RankMesh& mesh, const std::vector<Index>& vertices, const Points& values)
{
    std::vector<TableRow> own;
    for (std::size_t row = 0; row < vertices.size(); ++row)
        if (const Index v = vertices[row]; v >= 0 && mesh.has_own_faces(v))
            own.push_back({static_cast<std::int64_t>(row), {values(v, 0), values(v, 1), values(v, 2)}});
    Points table = Points::Zero(static_cast<Index>(vertices.size()), 3);
    for (const TableRow& of_row : comm.gather_all(own))
        table.row(of_row.row) = Point(of_row.values[0], of_row.values[1], of_row.values[2]);
    return table;
}

/// Leaves out components that are small on each rank alone.
void keep_small(const Points& table, double extent, IndexLists& rows)
{
    IndexLists kept;
    for (Index c = 0; c < rows.size(); ++c)
        if (is_smaller(table, rows[c], extent)) {
            kept.values.insert(kept.values.end(), rows[c].begin(), rows[c].end());
            kept.close();
        }
    rows = std::move(kept);
}

}  // namespace

FindSmallComponents find_small_components(Communicator& comm, const RankMesh& mesh)
{
    return [&comm, &mesh](const Points& positions, double extent) {
        SmallComponents small;
        const bool here = has_small_face(mesh.part.mesh, positions, extent);
        const auto anywhere = comm.gather_all(std::vector<std::uint8_t>{static_cast<std::uint8_t>(here ? 1 : 0)});
        if (std::ranges::find(anywhere, 1) == anywhere.end())
            return small;
        const OwnComponents own = find_own(mesh, positions, extent);
        std::int64_t first = 0;
        const auto counts = comm.gather_all(std::vector<std::int64_t>{own.of_vertices.count()});
        for (int rank = 0; rank < comm.rank(); ++rank)
            first += counts[rank];
        const auto is_shared = [&](Index v, Index) {
            return std::ranges::any_of(mesh.topology.corners_at(v),
                                       [&](Index corner) { return !is_own_corner(mesh, corner); });
        };
        const std::vector<std::uint8_t> may = comm.gather_all(own.may);
        const Components joined =
            join(comm.gather_all(members(mesh, own, first, is_shared)), static_cast<Index>(may.size()));
        std::vector<std::uint8_t> all_may(at(joined.count()), 1);
        for (Index c = 0; c < static_cast<Index>(may.size()); ++c)
            all_may[joined.component_of[c]] &= may[c];
        std::vector<Member> of_all = comm.gather_all(members(mesh, own, first, [&](Index, Index c) {
            return all_may[joined.component_of[static_cast<Index>(first) + c]] != 0;
        }));
        for (Member& member : of_all)
            member.component = joined.component_of[static_cast<Index>(member.component)];
        list(std::move(of_all), mesh, small);
        small.table = [&comm, &mesh, vertices = small.vertices](const Points& values) {
            return gather_table(comm, mesh, vertices, values);
        };
        keep_small(small.table(positions), extent, small.rows);
        return small;
    };
}

}  // namespace seamflow
