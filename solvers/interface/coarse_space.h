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

/// The coarse space: few unknowns for the part of the error that single sub-meshes cannot reduce. An equivalence class
/// of Γ is the set of vertices that the same sub-meshes share. On each class, the columns of Z are the functions that
/// equal a sub-mesh's weights W there, and 0 elsewhere. Their basis is well conditioned where weights hardly differ:
/// the constant, and the weights of all except the first sub-mesh minus their mean; for a single vertex only the
/// constant. Balances the Neumann-Neumann preconditioner (Mandel, "Balancing domain decomposition", 1993, with one
/// function for all classes of a sub-mesh) in the form in which an iteration needs no second product with S (A-DEF2 of
/// Tang, Nabben, Vuik and Erlangga 2009): y becomes y + Z E⁻¹ Zᵀ (r - S y), where E = Zᵀ S Z.
class CoarseSpace {
  public:
    /// All peers construct it together, each with the functions of all.
    /// @param copies, peers must outlive the space.
    /// @throws ComputationError if the analysis fails.
    CoarseSpace(const InterfaceCopies& copies, InterfacePeers& peers);
    CoarseSpace(const CoarseSpace&) = delete;
    CoarseSpace& operator=(const CoarseSpace&) = delete;

    /// Number of unknowns.
    [[nodiscard]] Index size() const { return copies_in_.size(); }

    /// Makes S Z and factorises E; all peers call this together.
    /// @param complements one per sub-mesh; those of foreign ones are not used.
    /// @param weights one per copy, positive, those of a vertex adding up to 1; or all 0 at vertices where functions
    /// are 0.
    void prepare(std::span<const DenseFactor> complements, std::span<const double> weights, const Executor& exec);

    /// y becomes y + Z E⁻¹ Zᵀ (residual - S y); all peers call this together.
    /// @param residual, y one row per vertex of Γ.
    void correct(const Points& residual, Points& y, const Executor& exec);

  private:
    /// E in the elimination ordering, and its factor.
    struct Energy {
        /// Per function: its unknown.
        std::vector<Index> unknown_of;
        std::optional<LdlSolver> solver;
        /// The entries on and above the diagonal; the places of `entries` among them, and of the diagonal.
        std::vector<double> values;
        std::vector<Index> slots;
        std::vector<Index> diagonal_slots;
        FactorPool memory;
        LdlWorkspace workspace;
        /// Empty if there are no functions, or E is not definite to rounding.
        std::optional<LdlFactor<double>> factor;
    };
    /// A class of vertices of Γ: the places of the sub-meshes that share it.
    struct VertexClass {
        std::vector<Index> sharing;
        bool is_single = false;

        [[nodiscard]] Index n_functions() const { return is_single ? 1 : static_cast<Index>(sharing.size()); }
    };
    /// What a peer sends to others when all terms of Zᵀ (r - S y) are collected: the sums for functions on classes all
    /// of whose sub-meshes are its own; the sums begun here, for functions on other classes; and its sub-meshes' terms
    /// for these.
    struct SentTerms {
        std::vector<Index> finished;
        std::vector<Index> begun;
        std::vector<Index> terms;
    };
    /// A sub-mesh's share.
    struct Share {
        /// To S Z: a column with DenseFactor::room for each function there, and zero columns up to a multiple of three.
        AlignedFloats product;
        /// Scale of the product (see DenseFactor).
        double scale = 1.0;
        /// To E: functions there by functions there.
        Eigen::MatrixXd energy;
    };

    void find_functions();
    [[nodiscard]] std::vector<VertexClass> classes_of_all(const std::vector<VertexClass>& here) const;
    void list_functions(const std::vector<VertexClass>& classes);
    void divide_terms(const std::vector<VertexClass>& classes);
    void analyse();
    [[nodiscard]] std::vector<MatrixEntry> entries() const;
    void set_functions(std::span<const double> weights, const Executor& exec);
    void multiply_functions(Index s, const DenseFactor& schur);
    void multiply_transposed(Index s, const Points& y);
    void assemble();
    void subtract_terms(Index f);
    void exchange_terms();

    const InterfaceCopies& copies_;
    InterfacePeers& peers_;
    /// Per copy: its function, and its contribution to that at its vertex.
    std::vector<Index> function_;
    std::vector<double> values_at_;
    /// Per function, its copies that are known here, in ascending order: all or none.
    IndexLists copies_in_;
    /// Per place: the functions on this sub-mesh's part of Γ, in ascending order.
    IndexLists functions_at_;
    /// Per function: its places among the values of `functions_at_`.
    IndexLists terms_of_;
    Energy energy_;
    /// Per sub-mesh.
    std::vector<Share> shares_;
    /// Per value of `functions_at_`, the sub-mesh's share of Zᵀ S y; per function, Zᵀ (r - S y), as far as it is known.
    Points products_with_y_;
    Points sums_;
    /// Per peer.
    std::vector<SentTerms> sent_;
    Columns coefficients_;
};

}  // namespace seamflow
