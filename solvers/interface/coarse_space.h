#pragma once

#include <optional>
#include <span>
#include <vector>

#include "partition/loop.h"
#include "solvers/columns.h"
#include "solvers/interface/interface_copies.h"
#include "solvers/ldl_solver.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// What the sub-meshes cannot settle each for itself: one unknown per sub-mesh that has a part of Γ, the height of a
/// plateau Z_s of the interface weights W there. Balances the Neumann-Neumann preconditioner (Mandel, "Balancing domain
/// decomposition", 1993), in the form in which one iteration needs no second product with S (Tang, Nabben, Vuik and
/// Erlangga 2009, A-DEF2): y becomes y + Z E⁻¹ Zᵀ (r - S y), where E = Zᵀ S Z.
class CoarseSpace {
  public:
    /// @param copies must outlive the space.
    /// @throws ComputationError if the analysis fails.
    explicit CoarseSpace(const InterfaceCopies& copies);
    ~CoarseSpace();
    CoarseSpace(const CoarseSpace&) = delete;
    CoarseSpace& operator=(const CoarseSpace&) = delete;

    /// Makes S Z and factorises E.
    /// @param systems factorised.
    /// @param weights one per copy, those of a vertex adding up to 1.
    void prepare(std::span<const NeumannSystem* const> systems, std::span<const double> weights, const Loop& loop);

    /// y becomes y + Z E⁻¹ Zᵀ (residual - S y).
    /// @param residual, y one row per vertex of Γ.
    /// @param weights those of `prepare`.
    void correct(const Points& residual, std::span<const double> weights, Points& y, const Loop& loop);

  private:
    void find_neighbours();
    void number_unknowns();
    void multiply_plateaus(Index s, const DenseFactor& schur, std::span<const double> weights);
    void assemble();
    void free_factor();

    const InterfaceCopies& copies_;
    /// Per sub-mesh: those that have a plateau on its part of Γ, itself included, in ascending order; empty where it has
    /// no part of Γ.
    IndexLists neighbours_;
    /// Per sub-mesh, or -1: its unknown, in the order of elimination.
    std::vector<Index> unknown_of_;
    Index n_unknowns_ = 0;
    SparsePattern upper_;
    std::optional<LdlSolver> solver_;
    LdlWorkspace workspace_;
    std::vector<double> values_;
    /// Per sub-mesh, its share of S Z: a column for each neighbour, and zeros to make their number a multiple of three.
    std::vector<std::vector<float>> products_;
    /// Per sub-mesh, its share of E: neighbours by neighbours.
    std::vector<Eigen::MatrixXd> energies_;
    /// Per neighbour of each sub-mesh, its share of Zᵀ S y.
    Points shares_;
    Columns heights_;
    bool factorised_ = false;
};

}  // namespace seamflow
