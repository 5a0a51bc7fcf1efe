#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/index_lists.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/laplacian/symmetric_laplacian.h"
#include "solvers/sparse/sparse_pattern.h"
#include "solvers/systems/screening.h"

namespace seamflow {

/// For each unknown, the pairs that contain it, with the other unknown of each.
struct PairsOfUnknowns {
    struct Entry {
        Index other;
        Index pair;
    };
    Lists<Entry> of;
    /// The number of all pairs, including pairs with a vertex that is not unknown.
    std::size_t n_pairs = 0;

    [[nodiscard]] Index n() const { return of.size(); }
};

/// Lists the pairs of two unknowns at both of them.
/// @param unknown_of per vertex, its unknown or -1; vertices beyond the end of the list are not unknown.
/// @param n number of unknowns.
/// @throws ComputationError if 2³¹ numbers or more must be kept, two for each pair and one for each unknown.
PairsOfUnknowns pairs_of_unknowns(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n);

/// All entries off the diagonal of the symmetric matrix, each once; rows in any order.
SparsePattern neighbours_of(const PairsOfUnknowns& pairs);

/// The upper triangle of the symmetric matrix with its diagonal, and the entry of each pair of vertices.
struct UpperPattern {
    SparsePattern pattern;
    /// Per pair: the index of its entry; -1 where a vertex of the pair is not unknown.
    std::vector<Index> slots;
};

/// The upper triangle of a matrix with an entry for each pair.
/// @param order the unknowns in the order of the matrix.
UpperPattern upper_pattern(const PairsOfUnknowns& pairs, const std::vector<Index>& order);

/// The symmetric matrix M + dt K + dt M w of a sub-mesh at its unknowns, refilled in each step. M is that of the
/// Laplacian, divided by the step scale (see Screening).
struct SymmetricMatrix {
    std::unique_ptr<SymmetricLaplacian> laplacian;
    /// The number of local vertices, the halo included, plus the number of auxiliary unknowns, which are numbered after
    /// the vertices.
    Index n_vertices = 0;
    /// Per unknown, in the elimination ordering: its vertex.
    std::vector<Index> vertex_of{};
    /// The column offsets of the upper triangle; the solver has the rows.
    std::vector<Index> column_offsets{};
    /// Per pair of the Laplacian, an index of a value: of an entry of the pattern, of one of the further values after
    /// the entries, or of the last value, which is never read.
    std::vector<Index> slots{};
    Screening screening{};

    /// Makes vertices unknowns, in their order, and after them the auxiliary unknowns (see SymmetricLaplacian) that are
    /// coupled with one of these vertices.
    /// @param pairs of the Laplacian. @param is_known per own vertex: 1 if it is no unknown.
    /// @returns per vertex and auxiliary unknown: its number, or -1.
    std::vector<Index> number_unknowns(const std::vector<VertexPair>& pairs, std::span<const std::uint8_t> is_known);
    /// Renumbers the unknowns.
    /// @param order the present number of each unknown, in the new order.
    void reorder(std::span<const Index> order);

    [[nodiscard]] Index n() const { return static_cast<Index>(vertex_of.size()); }
    [[nodiscard]] Index n_entries() const { return column_offsets.back(); }

    /// Whether v is a vertex, and not an auxiliary unknown.
    [[nodiscard]] bool is_vertex(Index v) const { return v < n_vertices - laplacian->n_auxiliary(); }

    /// The signs of the pivots: all positive, or with auxiliary unknowns the signs of the diagonal.
    [[nodiscard]] Pivots pivots() const
    {
        return laplacian->n_auxiliary() > 0 ? Pivots::LikeDiagonal : Pivots::Positive;
    }

    /// The index of the diagonal entry of an unknown, which is the last of its column.
    [[nodiscard]] Index diagonal_slot(Index unknown) const { return column_offsets[unknown + 1] - 1; }

    /// Fills in the values; the workspace receives the diagonal of dt K, and M.
    /// @param positions at least #own by 3, the halo where the Laplacian reaches it: Vᵏ.
    /// @param n_further the number of further values.
    /// @param product receives the product of dt K and positions; may be nullptr.
    /// @returns the entries and the further values, in the workspace.
    std::span<double> fill(const Points& positions, double time_step, std::size_t n_further, SolverWorkspace& workspace,
                           const StiffnessProduct* product = nullptr) const;
};

/// A matrix whose unknowns are not yet numbered.
/// @param faces of the sub-mesh.
SymmetricMatrix make_symmetric_matrix(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian,
                                      const FacesOnBothSides& faces, const FlowTerms& terms);

}  // namespace seamflow
