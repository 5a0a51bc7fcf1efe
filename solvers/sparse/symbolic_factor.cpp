#include "solvers/sparse/symbolic_factor.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "solvers/sparse/elimination_ordering.h"

namespace seamflow {

namespace {

// L is the factor of a matrix. A supernode is a run of consecutive columns of L that are stored with the same rows
// below them, so that they can be processed together. Entries of L that are stored but stay zero are called zeros here.

/// The entries on and above the diagonal of the pattern made symmetric, with renumbered unknowns.
/// @param position the new number of each unknown.
SparsePattern symmetrised(const SparsePattern& pattern, const std::vector<Index>& position)
{
    std::vector<MatrixEntry> entries;
    entries.reserve(pattern.n() + pattern.n_entries());
    for (Index column = 0; column < pattern.n(); ++column) {
        entries.push_back({position[column], position[column]});
        for (Index k = pattern.column_offsets[column]; k < pattern.column_offsets[column + 1]; ++k) {
            const Index a = position[column];
            const Index b = position[pattern.rows[k]];
            entries.push_back({std::max(a, b), std::min(a, b)});
        }
    }
    return make_pattern(pattern.n(), entries);
}

/// The elimination tree, whose counts have no zeros: a column counts the rows in which L has an entry. The entry of a
/// row and a column of the matrix makes entries of the same row in all columns on the way up from the column.
EliminationTree make_tree(const SparsePattern& upper)
{
    EliminationTree tree{std::vector<Index>(upper.n(), -1), std::vector<Index>(upper.n(), 0)};
    std::vector<Index> visited(upper.n(), -1);
    for (Index row = 0; row < upper.n(); ++row) {
        visited[row] = row;
        for (Index k = upper.column_offsets[row]; k < upper.column_offsets[row + 1]; ++k)
            for (Index column = upper.rows[k]; visited[column] != row; column = tree.parent[column]) {
                visited[column] = row;
                ++tree.count[column];
                if (tree.parent[column] < 0)
                    tree.parent[column] = row;
            }
    }
    return tree;
}

/// Whether two consecutive columns have the same rows except for the row of the second column itself.
bool belong_together(const EliminationTree& tree, Index column)
{
    return tree.parent[column] == column + 1 && tree.count[column] == tree.count[column + 1] + 1;
}

/// The last column of the supernode that begins with the column `first`, without merging: its columns have the same
/// rows in L, apart from their own. It has at most most_columns columns. The last n_last columns of the matrix are one
/// supernode in any case.
Index end_of_supernode(const EliminationTree& tree, Index first, Index n_last, Index most_columns)
{
    const auto n = static_cast<Index>(tree.parent.size());
    Index last = first == n - n_last ? n - 1 : first;
    while (last + 1 < n && last - first + 1 < most_columns && last + 1 != n - n_last && belong_together(tree, last))
        ++last;
    return last;
}

// Supernodes are merged into wider ones, which are faster, as long as this adds few zeros (measured on triangle meshes:
// more zeros save no more time, but take memory).

/// The largest width of a merged supernode, and the fraction of its entries that may be zeros.
constexpr Index most_merged_columns = 32;
constexpr double most_zeros = 0.15;
/// The same for narrow supernodes, which may have more of them.
constexpr Index most_narrow_columns = 8;
constexpr double most_zeros_if_narrow = 0.4;

/// Whether a supernode of `width` columns, and `n_rows` rows below them, may have so many zeros.
bool may_have(double zeros, Index width, Index n_rows)
{
    const double size = 0.5 * width * (width + 1.0) + 1.0 * width * n_rows;
    return (width <= most_narrow_columns && zeros <= most_zeros_if_narrow * size) ||
           (width <= most_merged_columns && zeros <= most_zeros * size);
}

/// Merges the supernode that begins with the column `first` with supernodes after it.
/// @param last the last column without merging.
/// @returns the last column of the widest supernode for which two conditions hold. It has few zeros (see may_have). And
/// the parents of all its columns but the last are in it: then the last column has all rows below the supernode that
/// any of its columns has.
Index end_of_merged_supernode(const EliminationTree& tree, Index first, Index last, Index n_last)
{
    const auto n = static_cast<Index>(tree.parent.size());
    double entries_before = 0.0;
    Index furthest_parent = first;
    Index next_column = first;
    for (Index top = last; top >= 0 && top < std::min(n - n_last, first + most_merged_columns);
         top = tree.parent[top]) {
        for (; next_column < top; ++next_column) {
            const Index parent = tree.parent[next_column];
            furthest_parent = parent < 0 ? n : std::max(furthest_parent, parent);
            entries_before += tree.count[next_column] + 1.0;
        }
        const Index width = top + 1 - first;
        const Index n_rows = tree.count[top];
        // The entries of the columns before `top` if these had all its rows, less the entries that they have.
        const double zeros = 0.5 * (width - 1.0) * width + (width - 1.0) * (n_rows + 1.0) - entries_before;
        // Only whole supernodes are merged.
        const bool is_end = top + 1 == n - n_last || !belong_together(tree, top);
        if (is_end && furthest_parent <= top && may_have(zeros, width, n_rows))
            last = top;
    }
    return last;
}

/// Whether supernodes may include entries of L that stay zero.
enum class Zeros {
    None,
    Few,
};

/// The limits of supernodes.
struct SupernodeLimits {
    Zeros zeros;
    /// The number of last unknowns, which form one supernode.
    Index n_last;
    /// The most columns of a supernode before it is merged.
    Index most_columns;
};

/// Fills in the supernodes. Calls on_row(row, supernode, row_index) for each row that a supernode has outside its own
/// columns, rows ascending; row_index is the index of the row among the rows of the supernode. Calls on_entry(slot,
/// row_index) for each entry of the matrix in order; there row_index is the index of its column among the rows of the
/// supernode of its row.
template <class OnRow, class OnEntry>
void list_supernodes(const SparsePattern& upper, const EliminationTree& tree, const SupernodeLimits& limits,
                     SymbolicFactor& factor, OnRow on_row, OnEntry on_entry)
{
    const Index n = upper.n();
    std::vector<Index> supernode_of(n);
    std::vector<Index> parent;
    for (Index first = 0, last = 0; first < n; first = ++last) {
        last = end_of_supernode(tree, first, limits.n_last, limits.most_columns);
        if (limits.zeros == Zeros::Few)
            last = end_of_merged_supernode(tree, first, last, limits.n_last);
        std::fill(supernode_of.begin() + first, supernode_of.begin() + last + 1, factor.n_supernodes());
        parent.push_back(tree.parent[last]);
        factor.first.push_back(last + 1);
        for (Index u = first; u <= last; ++u)
            factor.rows.values.push_back(u);
        factor.rows.values.resize(factor.rows.values.size() + usize(tree.count[last]));
        factor.rows.close();
    }
    factor.first.shrink_to_fit();
    factor.rows.shrink_to_fit();
    std::vector<Index> next(factor.n_supernodes());
    for (Index b = 0; b < factor.n_supernodes(); ++b)
        next[b] = factor.rows.offsets[b] + factor.width(b);
    std::vector<Index> visited(factor.n_supernodes(), -1);
    for (Index row = 0; row < n; ++row) {
        const Index own = supernode_of[row];
        visited[own] = row;
        for (Index k = upper.column_offsets[row]; k < upper.column_offsets[row + 1]; ++k) {
            const Index supernode = supernode_of[upper.rows[k]];
            for (Index b = supernode; visited[b] != row; b = supernode_of[parent[b]]) {
                visited[b] = row;
                factor.rows.values[next[b]] = row;
                on_row(row, b, next[b]++ - factor.rows.offsets[b]);
            }
            on_entry(k,
                     supernode == own ? row - factor.first[own] : next[supernode] - 1 - factor.rows.offsets[supernode]);
        }
    }
    assert(std::equal(next.begin(), next.end(), factor.rows.offsets.begin() + 1) &&
           "supernodes have as many rows as the tree says");
}

}  // namespace

SymbolicFactor make_symbolic_factor(const SparsePattern& pattern)
{
    const Index n = pattern.n();
    SymbolicFactor factor;
    factor.position.resize(n);
    std::iota(factor.position.begin(), factor.position.end(), 0);
    const std::vector<Index> order = elimination_ordering(symmetrised(pattern, factor.position));
    for (Index i = 0; i < n; ++i)
        factor.position[order[i]] = i;

    factor.update_offsets.assign(usize(n) + 1, 0);
    const SparsePattern upper = symmetrised(pattern, factor.position);
    list_supernodes(
        upper, make_tree(upper), {.zeros = Zeros::None, .n_last = 0, .most_columns = n}, factor,
        [&](Index row, Index supernode, Index row_index) {
            factor.updates.push_back({supernode, row_index});
            ++factor.update_offsets[row + 1];
        },
        [](Index, Index) {});
    std::partial_sum(factor.update_offsets.begin(), factor.update_offsets.end(), factor.update_offsets.begin());
    return factor;
}

SymbolicFactor make_symmetric_symbolic_factor(const SparsePattern& upper, Index n_last, const EliminationTree& tree,
                                              std::vector<Index>& row_indices, Index most_columns)
{
    assert((tree.parent.empty() || n_last == 0) && "the tree knows of no last unknowns");
    const EliminationTree own_tree = tree.parent.empty() ? make_tree(upper) : EliminationTree{};
    SymbolicFactor factor;
    row_indices.resize(upper.rows.size());
    list_supernodes(
        upper, tree.parent.empty() ? own_tree : tree,
        {.zeros = Zeros::Few, .n_last = n_last, .most_columns = most_columns}, factor, [](Index, Index, Index) {},
        [&](Index entry, Index row_index) { row_indices[entry] = row_index; });
    return factor;
}

}  // namespace seamflow
