#include "solvers/systems/symmetric_matrix.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "partition/errors.h"
#include "solvers/laplacian/kept_stiffness.h"

namespace seamflow {

namespace {

/// Throws a ComputationError if a system of n unknowns has more entries than an Index can count.
void require_countable(std::size_t n_entries, Index n)
{
    if (n_entries > usize(std::numeric_limits<Index>::max()))
        throw ComputationError("a system of " + std::to_string(n) +
                               " unknowns has too many entries: cut the mesh into more sub-meshes");
}

}  // namespace

PairsOfUnknowns pairs_of_unknowns(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n)
{
    require_countable(2 * pairs.size() + usize(n), n);
    const auto n_own = static_cast<Index>(unknown_of.size());
    const auto unknown = [&](Index v) { return v < n_own ? unknown_of[v] : -1; };
    return {make_lists<PairsOfUnknowns::Entry>(n,
                                               [&](auto&& add) {
                                                   for (std::size_t i = 0; i < pairs.size(); ++i) {
                                                       const Index a = unknown(pairs[i].first);
                                                       const Index b = unknown(pairs[i].second);
                                                       if (a < 0 || b < 0)
                                                           continue;
                                                       add(a, {b, static_cast<Index>(i)});
                                                       add(b, {a, static_cast<Index>(i)});
                                                   }
                                               }),
            pairs.size()};
}

SparsePattern neighbours_of(const PairsOfUnknowns& pairs)
{
    SparsePattern neighbours;
    neighbours.column_offsets.reserve(pairs.of.offsets.size());
    neighbours.rows.resize(pairs.of.values.size());
    std::vector<Index> seen_in(pairs.n(), -1);
    Index end = 0;
    for (Index u = 0; u < pairs.n(); ++u) {
        for (const auto& [other, pair] : pairs.of[u]) {
            neighbours.rows[end] = other;
            end += std::exchange(seen_in[other], u) != u ? 1 : 0;
        }
        neighbours.column_offsets.push_back(end);
    }
    neighbours.rows.resize(end);
    return neighbours;
}

/// Entries are visited row by row, so that the rows of each column come in ascending order.
UpperPattern upper_pattern(const PairsOfUnknowns& pairs, const std::vector<Index>& order)
{
    const Index n = pairs.n();
    std::vector<Index> number_of(n);
    for (Index u = 0; u < n; ++u)
        number_of[order[u]] = u;
    // Calls action(row, column, pair, is_new); is_new is false if an earlier pair has the same entry.
    const auto for_each_entry_above_diagonal = [&](auto&& action) {
        std::vector<Index> last_row_of(n, -1);
        for (Index row = 0; row < n; ++row)
            for (const auto& [other, pair] : pairs.of[order[row]])
                if (const Index column = number_of[other]; column > row)
                    action(row, column, pair, std::exchange(last_row_of[column], row) != row);
    };
    // The members are set one by one: if memory runs out for a later member, GCC 12 destroys members made from {}
    // twice.
    UpperPattern upper;
    upper.slots.assign(pairs.n_pairs, -1);
    std::vector<Index>& offsets = upper.pattern.column_offsets;
    std::vector<Index>& rows = upper.pattern.rows;
    // The beginning of each column is stored at the next index but one, and advances to the column's end.
    offsets.assign(usize(n) + 2, 1);
    offsets[0] = offsets[1] = 0;
    for_each_entry_above_diagonal(
        [&](Index, Index column, Index, bool is_new) { offsets[column + 2] += is_new ? 1 : 0; });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    rows.resize(offsets.back());
    for_each_entry_above_diagonal([&](Index row, Index column, Index pair, bool is_new) {
        Index& end = offsets[column + 1];
        end += is_new ? 1 : 0;
        rows[end - 1] = row;
        upper.slots[pair] = end - 1;
    });
    for (Index u = 0; u < n; ++u)
        rows[offsets[u + 1]++] = u;
    offsets.pop_back();
    return upper;
}

std::vector<Index> SymmetricMatrix::number_unknowns(const std::vector<VertexPair>& pairs,
                                                    std::span<const std::uint8_t> is_known)
{
    const Index first = n_vertices;
    n_vertices += laplacian->n_auxiliary();
    // 0 marks the future unknowns until they are numbered.
    std::vector<Index> unknown_of(usize(n_vertices), -1);
    for (std::size_t v = 0; v < is_known.size(); ++v)
        unknown_of[v] = is_known[v] == 0 ? 0 : -1;
    for (const auto& [v, w] : first < n_vertices ? std::span(pairs) : std::span<const VertexPair>())
        if (w >= first && unknown_of[v] >= 0)
            unknown_of[w] = 0;
    for (Index v = 0; v < n_vertices; ++v)
        if (unknown_of[v] == 0) {
            unknown_of[v] = n();
            vertex_of.push_back(v);
        }
    return unknown_of;
}

void SymmetricMatrix::reorder(std::span<const Index> order)
{
    std::vector<Index> reordered(vertex_of.size());
    std::ranges::transform(order, reordered.begin(), [&](Index u) { return vertex_of[u]; });
    vertex_of = std::move(reordered);
}

SymmetricMatrix make_symmetric_matrix(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian,
                                      const FacesOnBothSides& faces, const FlowTerms& terms)
{
    SymmetricMatrix matrix{make_symmetric_laplacian(laplacian, faces, most_corners_without_auxiliary),
                           faces.n_vertices};
    const std::span<const Index> local_to_global = sub_mesh.local_to_global;
    matrix.screening = make_screening(terms, local_to_global.first(usize(sub_mesh.n_vertices)));
    if (terms.keeps_stiffness)
        matrix.laplacian = keep_stiffness(std::move(matrix.laplacian), faces.n_vertices,
                                          rows_of(*terms.initial, local_to_global), terms.keeps_mass);
    return matrix;
}

std::span<double> SymmetricMatrix::fill(const Points& positions, double time_step, std::size_t n_further,
                                        SolverWorkspace& workspace, const StiffnessProduct* product) const
{
    const std::size_t n_values = usize(n_entries()) + n_further;
    workspace.values.assign(n_values + 1, 0.0);
    workspace.diagonal.resize(n_vertices);
    workspace.mass.resize(n_vertices);
    laplacian->assemble(positions, time_step, slots, workspace.values, workspace.diagonal, workspace.mass, product);
    for (Index u = 0; u < n(); ++u) {
        const Index v = vertex_of[u];
        if (!is_vertex(v)) {
            workspace.values[diagonal_slot(u)] = workspace.diagonal[v];
            continue;
        }
        workspace.mass[v] /= screening.step_scale(v);
        workspace.values[diagonal_slot(u)] =
            workspace.mass[v] * (1.0 + time_step * screening.weight(v)) + workspace.diagonal[v];
    }
    return std::span(workspace.values).first(n_values);
}

}  // namespace seamflow
