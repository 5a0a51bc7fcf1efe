#include "solvers/sparse/elimination_ordering.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <amd.h>
#include <camd.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

static_assert(AMD_OK == CAMD_OK);

[[noreturn]] void fail_for_memory()
{
    throw ComputationError("out of memory in the analysis of the system: use more sub-meshes");
}

/// The result of AMD. Unknowns that are eliminated together are a group, named by one of them, its principal.
struct AmdResult {
    explicit AmdResult(SparsePattern neighbours);

    /// Per unknown: its position in the order; and the unknown at each position.
    std::vector<Index> position;
    std::vector<Index> order;
    /// Per principal, the number of unknowns of its group; 0 for other unknowns. The group is consecutive in the order,
    /// the principal last.
    std::vector<Index> width;
    /// Per principal, the number of rows in which the columns of its group have entries, including the group's own
    /// rows.
    std::vector<Index> front;
    /// Per principal, the principal of its parent in the elimination tree, or -1. Per other unknown, its principal, or
    /// -1 if AMD has put it last without analysis because it has very many neighbours.
    std::vector<Index> parent;
};

/// Calls AMD's inner routine, which returns more than the outer one but destroys its input, and does not check it.
AmdResult::AmdResult(SparsePattern neighbours)
{
    const auto n = static_cast<std::size_t>(neighbours.n());
    const std::size_t n_entries = neighbours.rows.size();
    // The size of the workspace that AMD itself chooses.
    const std::size_t room = n_entries + n_entries / 5 + n;
    if (room > usize(std::numeric_limits<Index>::max()))
        fail_for_memory();
    const Index end = neighbours.n_entries();
    std::vector<Index>& lists = neighbours.rows;
    lists.resize(room);
    std::vector<Index> length(n);
    for (std::size_t i = 0; i < n; ++i)
        length[i] = neighbours.column_offsets[i + 1] - neighbours.column_offsets[i];
    // In: the beginning of each list. Out: the parents.
    parent.assign(neighbours.column_offsets.begin(), neighbours.column_offsets.end() - 1);
    for (auto* result : {&position, &order, &width, &front})
        result->resize(n);
    std::vector<Index> head(n);
    std::vector<Index> degree(n);
    std::vector<Index> marks(n);
    amd_2(static_cast<Index>(n), parent.data(), lists.data(), length.data(), static_cast<Index>(room), end,
          width.data(), position.data(), order.data(), head.data(), front.data(), degree.data(), marks.data(), nullptr,
          nullptr);
}

/// The elimination tree; empty if some unknowns were not analysed.
EliminationTree tree_of(const AmdResult& amd)
{
    const std::size_t n = amd.order.size();
    // The members are set one by one: if memory runs out for a later member, GCC 12 destroys members made from {}
    // twice.
    EliminationTree tree;
    tree.parent.resize(n);
    tree.count.resize(n);
    const auto first_of = [&](Index principal) { return amd.position[principal] - amd.width[principal] + 1; };
    for (std::size_t principal = 0; principal < n; ++principal) {
        const Index parent = amd.parent[principal];
        if (amd.width[principal] == 0) {
            if (parent < 0)
                return {};
            continue;
        }
        Index n_rows = amd.front[principal];
        for (Index column = first_of(static_cast<Index>(principal)); column <= amd.position[principal]; ++column) {
            tree.parent[column] = column + 1;
            tree.count[column] = --n_rows;
        }
        tree.parent[amd.position[principal]] = parent < 0 ? -1 : first_of(parent);
    }
    return tree;
}

}  // namespace

EliminationOrdering order_elimination(SparsePattern neighbours)
{
    if (neighbours.n() == 0)
        return {};
    AmdResult amd(std::move(neighbours));
    EliminationTree tree = tree_of(amd);
    return {std::move(amd.order), std::move(tree)};
}

std::vector<Index> elimination_ordering(const SparsePattern& upper, const std::vector<bool>& is_last)
{
    std::vector<Index> order(upper.n());
    if (order.empty())
        return order;
    const Index* const offsets = upper.column_offsets.data();
    const Index* const rows = upper.rows.data();
    const std::vector<Index> groups(is_last.begin(), is_last.end());
    // CAMD supports at most as many groups as there are unknowns, so that a single unknown cannot be in the second
    // group.
    const bool has_groups = groups.size() > 1 && std::ranges::find(groups, 1) != groups.end();
    const int status = has_groups ? camd_order(upper.n(), offsets, rows, order.data(), nullptr, nullptr, groups.data())
                                  : amd_order(upper.n(), offsets, rows, order.data(), nullptr, nullptr);
    if (status < AMD_OK)
        fail_for_memory();
    return order;
}

}  // namespace seamflow
