#pragma once

#include <optional>
#include <span>
#include <vector>

#include "partition/index_lists.h"
#include "partition/loop.h"
#include "solvers/columns.h"
#include "solvers/interface/interface_copies.h"
#include "solvers/ldl_solver.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// What the sub-meshes cannot settle each for itself, as few unknowns: a sub-mesh's weights W on one stretch of Γ, the
/// vertices that it shares with the same others, are a plateau, of which the unknown is the height; where a stretch is
/// a single vertex, those of all its sub-meshes are one. Balances the Neumann-Neumann preconditioner (Mandel,
/// "Balancing domain decomposition", 1993, with one plateau for all of a sub-mesh's Γ) in the form in which an
/// iteration needs no second product with S (A-DEF2 of Tang, Nabben, Vuik and Erlangga 2009): y becomes y + Z E⁻¹ Zᵀ (r
/// - S y), where E = Zᵀ S Z and Z has a column for each plateau.
class CoarseSpace {
  public:
    /// @param copies must outlive the space.
    /// @throws ComputationError if the analysis fails.
    explicit CoarseSpace(const InterfaceCopies& copies);
    ~CoarseSpace();
    CoarseSpace(const CoarseSpace&) = delete;
    CoarseSpace& operator=(const CoarseSpace&) = delete;

    /// Number of unknowns.
    [[nodiscard]] Index size() const { return copies_in_.size(); }

    /// Makes S Z and factorises E.
    /// @param systems factorised.
    /// @param weights one per copy, positive, those of a vertex adding up to 1.
    void prepare(std::span<const NeumannSystem* const> systems, std::span<const double> weights, const Loop& loop);

    /// y becomes y + Z E⁻¹ Zᵀ (residual - S y).
    /// @param residual, y one row per vertex of Γ.
    /// @param weights those of `prepare`.
    void correct(const Points& residual, std::span<const double> weights, Points& y, const Loop& loop);

  private:
    void find_plateaus();
    void list_plateaus();
    void analyse();
    [[nodiscard]] std::vector<MatrixEntry> entries() const;
    void multiply_plateaus(Index s, const DenseFactor& schur, std::span<const double> weights);
    void multiply_transposed(Index s, const Points& y);
    void assemble();
    void free_factor();

    const InterfaceCopies& copies_;
    /// Per copy: the plateau that has its weight.
    std::vector<Index> plateau_;
    /// Per plateau its copies, in ascending order.
    IndexLists copies_in_;
    /// Per sub-mesh: the plateaus on its part of Γ, others' too, in ascending order.
    IndexLists plateaus_at_;
    /// Per plateau: where it stands among the values of `plateaus_at_`.
    IndexLists places_;
    /// Per plateau: its unknown, in the order of elimination.
    std::vector<Index> unknown_of_;
    std::optional<LdlSolver> solver_;
    LdlWorkspace workspace_;
    /// The entries of E, on and above the diagonal; where each of `entries` stands among them, and the diagonal.
    std::vector<double> values_;
    std::vector<Index> slots_;
    std::vector<Index> diagonal_slots_;
    /// Per sub-mesh, its share of S Z: a column for each plateau there, and zeros to make their number a multiple of
    /// three.
    std::vector<std::vector<float>> products_;
    /// Per sub-mesh, its share of E: plateaus there by plateaus there.
    std::vector<Eigen::MatrixXd> energies_;
    /// Per value of `plateaus_at_`, the sub-mesh's share of Zᵀ S y.
    Points shares_;
    Columns heights_;
    bool is_factorised_ = false;
};

}  // namespace seamflow
