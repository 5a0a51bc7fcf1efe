#pragma once

#include <optional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/dense_factor.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/interface/interface_copies.h"

namespace seamflow {

/// The coarse space: few unknowns for the component of the error that single sub-meshes cannot reduce, when the
/// equations S x = r on Γ, the vertices that sub-meshes share, are solved by an iteration. S is the Schur complement, a
/// sum of one complement for each sub-mesh. An equivalence class of Γ is a set of vertices that the same sub-meshes
/// share. On each class, the columns of Z are functions that equal a sub-mesh's weights W there, and 0 elsewhere; the
/// weights divide each vertex among its sub-meshes. Their basis is well conditioned where weights hardly differ: the
/// constant, and the weights of all sub-meshes except the first minus their mean; for a single vertex only the
/// constant. The coarse space balances the Neumann-Neumann preconditioner (Mandel, "Balancing domain decomposition",
/// 1993, with one function for all classes of a sub-mesh) in the form in which an iteration needs no second product
/// with S (A-DEF2 of Tang, Nabben, Vuik and Erlangga 2009): y becomes y + Z E⁻¹ Zᵀ (r - S y), where E = Zᵀ S Z.
class CoarseSpace {
  public:
    /// All ranks construct the space together. Each knows the functions of all classes.
    /// @param copies, ranks must outlive the space.
    /// @throws ComputationError if the analysis fails.
    CoarseSpace(const InterfaceCopies& copies, InterfaceRanks& ranks);
    CoarseSpace(const CoarseSpace&) = delete;
    CoarseSpace& operator=(const CoarseSpace&) = delete;

    /// Number of unknowns.
    [[nodiscard]] Index size() const { return copies_in_.size(); }

    /// Makes S Z and factorises E = Zᵀ S Z; all ranks call this together.
    /// @param complements one per sub-mesh, which add up to S; the complements of remote sub-meshes are not read.
    /// @param weights one per copy, positive; the weights of a vertex add up to 1, or are all 0 for a vertex where all
    ///        functions are to be 0.
    void prepare(std::span<const DenseFactor> complements, std::span<const double> weights, const Executor& exec);

    /// y becomes y + Z E⁻¹ Zᵀ (residual - S y); all ranks call this together.
    /// @param residual, y one row per vertex of Γ.
    void correct(const Points& residual, Points& y, const Executor& exec);

  private:
    /// The matrix E = Zᵀ S Z, in the elimination ordering, and its factor.
    struct Energy {
        /// Per function: its unknown.
        std::vector<Index> unknown_of;
        std::optional<LdlSolver> solver;
        /// The values of the entries on and above the diagonal; the indices in `values` of the entries in the order of
        /// `entries`, and of the diagonal entries.
        std::vector<double> values;
        std::vector<Index> slots;
        std::vector<Index> diagonal_slots;
        FactorPool memory;
        LdlWorkspace workspace;
        /// Empty if there are no functions, or E is not definite to rounding.
        std::optional<LdlFactor<double>> factor;
    };
    /// A class of vertices of Γ: the global numbers of the sub-meshes that share it, and whether it has a single
    /// vertex.
    struct VertexClass {
        std::vector<Index> sharing;
        bool is_single = false;

        [[nodiscard]] Index n_functions() const { return is_single ? 1 : static_cast<Index>(sharing.size()); }
    };
    /// The data that a rank sends to others when all terms of Zᵀ (r - S y) are collected: sums for functions on classes
    /// whose sub-meshes are all its own; partial sums for functions on other classes; and its sub-meshes' terms for
    /// functions on other classes.
    struct SentTerms {
        std::vector<Index> finished;
        std::vector<Index> begun;
        std::vector<Index> terms;
    };
    /// The contribution of a sub-mesh to S Z and to E.
    struct Share {
        /// S Z: a column with DenseFactor::room for each function of the sub-mesh, and zero columns up to a multiple of
        /// three.
        AlignedFloats product;
        /// The scale of `product` (see DenseFactor).
        double scale = 1.0;
        /// E: functions of the sub-mesh by functions of the sub-mesh.
        Eigen::MatrixXd energy;
    };

    void find_functions();
    [[nodiscard]] std::vector<VertexClass> classes_of_all(const std::vector<VertexClass>& here) const;
    void list_functions(const std::vector<VertexClass>& classes);
    void divide_terms(const std::vector<VertexClass>& classes);
    void analyse();
    [[nodiscard]] std::vector<MatrixEntry> entries() const;
    void set_functions(std::span<const double> weights, const Executor& exec);
    void compute_share(Index s, const DenseFactor& schur);
    void multiply_transposed(Index s, const Points& y);
    void assemble();
    void subtract_terms(Index f);
    void exchange_terms();

    const InterfaceCopies& copies_;
    InterfaceRanks& ranks_;
    /// Per copy: its function, and the value of this function at the copy's vertex.
    std::vector<Index> function_;
    std::vector<double> values_at_;
    /// Per function: its copies, in ascending order. Either all of them are known on this rank, or the list is empty.
    IndexLists copies_in_;
    /// Per global number of a sub-mesh: the functions on its part of Γ, in ascending order.
    IndexLists functions_at_;
    /// Per function: its indices among the values of `functions_at_`.
    IndexLists terms_of_;
    Energy energy_;
    /// Per sub-mesh.
    std::vector<Share> shares_;
    /// Per value of `functions_at_`: the sub-mesh's share of Zᵀ S y. Per function: the terms of Zᵀ (r - S y) that are
    /// known on this rank.
    Points products_with_y_;
    Points sums_;
    /// Per rank.
    std::vector<SentTerms> sent_;
    Columns coefficients_;
};

}  // namespace seamflow
