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

/// The pairs of each unknown with others, from either end.
struct PairsOfUnknowns {
    struct Entry {
        Index other;
        Index pair;
    };
    Lists<Entry> of;
    /// Number of all pairs, including those of which not both are unknown.
    std::size_t n_pairs = 0;

    [[nodiscard]] Index n() const { return of.size(); }
};

/// @param unknown_of per vertex, or -1; vertices beyond its end are not unknown.
/// @param n number of unknowns.
/// @throws ComputationError if 2³¹ numbers or more must be kept, two for each pair and one for each unknown.
PairsOfUnknowns pairs_of_unknowns(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n);

/// All entries off the diagonal of the symmetric matrix, each once; rows in any order.
SparsePattern neighbours_of(const PairsOfUnknowns& pairs);

/// The upper triangle of the symmetric matrix with its diagonal, and the places of pairs of vertices in it.
struct UpperPattern {
    SparsePattern pattern;
    /// Per pair: its entry; -1 where not both are unknown.
    std::vector<Index> slots;
};

/// @param order the unknowns in the order of the matrix.
UpperPattern upper_pattern(const PairsOfUnknowns& pairs, const std::vector<Index>& order);

/// The symmetric matrix M + dt K + dt M w of a sub-mesh at its unknowns, refilled in each step. M is that of the
/// Laplacian over the step scale (see Screening).
struct SymmetricMatrix {
    std::unique_ptr<SymmetricLaplacian> laplacian;
    /// Of the sub-mesh, its halo included, and the auxiliary unknowns behind them.
    Index n_vertices = 0;
    /// Per unknown, in the elimination ordering.
    std::vector<Index> vertex_of{};
    /// Of the pattern of the upper triangle, whose rows the solver has.
    std::vector<Index> column_offsets{};
    /// Per pair of the Laplacian: an entry of the pattern, one of the further values behind them, or the last value of
    /// all, which is unused.
    std::vector<Index> slots{};
    Screening screening{};

    /// Makes vertices unknowns, in their order, and behind them those auxiliary unknowns (see SymmetricLaplacian) that
    /// are coupled with one.
    /// @param pairs of the Laplacian. @param is_known per own vertex.
    /// @returns per vertex and auxiliary unknown: its number, or -1.
    std::vector<Index> number_unknowns(const std::vector<VertexPair>& pairs, std::span<const std::uint8_t> is_known);
    /// Renumbers the unknowns.
    void reorder(std::span<const Index> order);

    [[nodiscard]] Index n() const { return static_cast<Index>(vertex_of.size()); }
    [[nodiscard]] Index n_entries() const { return column_offsets.back(); }

    /// Whether an unknown's "vertex" is one, not auxiliary.
    [[nodiscard]] bool is_vertex(Index v) const { return v < n_vertices - laplacian->n_auxiliary(); }

    /// Signs of the pivots: all positive, or with auxiliary unknowns those of the diagonal.
    [[nodiscard]] Pivots pivots() const
    {
        return laplacian->n_auxiliary() > 0 ? Pivots::LikeDiagonal : Pivots::Positive;
    }

    /// The diagonal entry of an unknown, the last of its column.
    [[nodiscard]] Index diagonal_slot(Index unknown) const { return column_offsets[unknown + 1] - 1; }

    /// Fills in the values, and dt K's diagonal and M in the workspace.
    /// @param positions at least #own by 3, the halo where the Laplacian reaches it: Vᵏ.
    /// @param n_further values.
    /// @param product see SymmetricLaplacian::assemble.
    /// @returns the entries and the further values, in the workspace.
    std::span<double> fill(const Points& positions, double time_step, std::size_t n_further, SolverWorkspace& workspace,
                           const StiffnessProduct* product = nullptr) const;
};

/// Without unknowns yet.
/// @param faces of the sub-mesh.
SymmetricMatrix make_symmetric_matrix(const SubMesh& sub_mesh, const ScaledLaplacian& laplacian,
                                      const FacesOnBothSides& faces, const FlowTerms& terms);

}  // namespace seamflow
