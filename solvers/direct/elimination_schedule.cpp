#include "solvers/direct/elimination_schedule.h"

#include <cstddef>
#include <utility>

namespace seamflow {

namespace {

/// The least work, in multiplications, for which several threads are used.
constexpr double least_work = 2e7;
/// The largest share of all work that a subtree or a group has.
constexpr double largest_share = 1.0 / 32.0;

/// Per supernode, the work of its subtree, its own included, in multiplications.
std::vector<double> work_of_subtrees(const SymbolicFactor& pattern, const std::vector<Index>& parent)
{
    std::vector<double> work(parent.size(), 0.0);
    for (std::size_t b = 0; b < parent.size(); ++b) {
        const auto n_rows = static_cast<double>(pattern.rows[static_cast<Index>(b)].size());
        work[b] += 0.5 * pattern.width(static_cast<Index>(b)) * n_rows * n_rows;
        if (parent[b] >= 0)
            work[usize(parent[b])] += work[b];
    }
    return work;
}

}  // namespace

EliminationSchedule schedule_elimination(const SymbolicFactor& pattern, const std::vector<Index>& supernode_of)
{
    const Index n = pattern.n_supernodes();
    std::vector<Index> parent(usize(n), -1);
    for (Index b = 0; b < n; ++b)
        if (const auto rows = pattern.rows[b]; std::ssize(rows) > pattern.width(b))
            parent[b] = supernode_of[rows[usize(pattern.width(b))]];
    const std::vector<double> work = work_of_subtrees(pattern, parent);
    double all = 0.0;
    for (Index b = 0; b < n; ++b)
        all += parent[b] < 0 ? work[b] : 0.0;
    EliminationSchedule schedule;
    if (all < least_work)
        return schedule;
    schedule.index_above.assign(usize(n), -1);
    for (Index b = 0; b < n; ++b)
        if (work[b] > largest_share * all) {
            schedule.index_above[b] = static_cast<Index>(schedule.above.size());
            schedule.above.push_back(b);
        }
    // Subtrees are assigned in the order of their roots; a supernode is in the group of its parent.
    std::vector<Index> group_of(usize(n), -1);
    Index n_groups = 0;
    double gathered = 0.0;
    for (Index b = n; b-- > 0;) {
        if (schedule.index_above[b] >= 0)
            continue;
        if (parent[b] >= 0 && schedule.index_above[parent[b]] < 0) {
            group_of[b] = group_of[parent[b]];
            continue;
        }
        if (n_groups == 0 || gathered + work[b] > largest_share * all) {
            ++n_groups;
            gathered = 0.0;
        }
        gathered += work[b];
        group_of[b] = n_groups - 1;
    }
    schedule.groups = make_lists(n_groups, [&](auto&& add) {
        for (Index b = 0; b < n; ++b)
            if (group_of[b] >= 0)
                add(group_of[b], b);
    });
    return schedule;
}

}  // namespace seamflow
