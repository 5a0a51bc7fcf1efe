#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/estimate/whole_rows.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/interface/interface_sums.h"
#include "solvers/interface/shared_rows.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The equation T e = r for the error of a decomposed step on Γ (see ErrorRow), one row per vertex of Γ. Ranks solve it
/// together, each with the rows of its own sub-meshes. The bits depend neither on how loops are run nor on the number
/// of ranks.
class ErrorEquation {
  public:
    /// @param decomposition, ranks must outlive this. Sub-meshes do not overlap. Sub-meshes of other ranks are
    ///        fragments (see decompose_part); with fragments, the Laplacian is not Δ_P.
    ErrorEquation(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                  const ScaledLaplacian& laplacian, InterfaceRanks& ranks, const Executor& exec = run_serially);

    /// The number of vertices on Γ that this rank numbers. Each vertex is numbered by the lowest sub-mesh that has it,
    /// sub-mesh by sub-mesh.
    [[nodiscard]] Index size() const { return static_cast<Index>(rows_.diagonal.size()); }

    /// The lowest number of a vertex that sub-mesh s numbers; first(#sub-meshes) is size().
    [[nodiscard]] Index first(Index s) const { return numbering_.first[s]; }

    /// The local index of a vertex in the sub-mesh that numbers it.
    [[nodiscard]] Index local_vertex(Index i) const { return numbering_.local_vertex[i]; }

    /// Fills in the rows at the vertices that sub-mesh s numbers. Different sub-meshes may do so at the same time.
    /// @param before, after #local by 3, the halo included: Vᵏ, and Vᵏ⁺¹ as solved.
    /// @param stiffness_at #local by 3: the positions at which the step has K: Vᵏ, or V⁰ if K is kept.
    /// @param time_step dt, in length².
    void assemble(Index s, const Points& before, const Points& after, const Points& stiffness_at, double time_step);

    /// Replaces the right-hand side by the one of Δ_P (Laplacian::PtackovaVelho), whose rows reach further than the
    /// faces that one sub-mesh knows. All ranks call this together.
    /// @param before, after #V by 3: Vᵏ, and Vᵏ⁺¹ as solved, where WholeRows::measure needs them.
    void measure_whole_rows(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                            const Points& after, double time_step, const Executor& exec);

    /// Adds the term dt M w to row i, after `assemble`: it pulls the vertex back to V⁰ (see FlowTerms).
    /// @param weight dt w. @param distance the vector from V⁰ to Vᵏ⁺¹ as solved, in length.
    void attach(Index i, double weight, const Point& distance)
    {
        const double entry = weight * rows_.mass[i];
        rows_.diagonal[i] += entry;
        rows_.row_sum[i] += entry;
        iteration_.residual.row(i) += entry * distance;
    }

    /// Adds to the right-hand side the displacement d of a single vertex of Γ, in length, which the step spreads.
    void add_displacement(Index i, const Point& d) { iteration_.residual.row(i) += rows_.mass[i] * d; }

    /// Adds to the right-hand side an error d, in length, that decays away from Γ. The equation returns it unchanged if
    /// it is smooth along Γ, and smoothed if it is rough.
    void add_error(Index i, const Point& d) { iteration_.residual.row(i) += rows_.row_sum[i] * d; }

    /// The unit normal of the surface at Vᵏ; zero if the surface has none there.
    [[nodiscard]] Point normal(Index i) const { return rows_.normal.row(i); }

    /// Solves to two digits; at most 30 iterations. May be called once after the rows have been filled in, because it
    /// changes them. All ranks call this together.
    void solve(const Executor& exec);

    /// #Γ by 3, in units of length. Not finite where the rows are not finite.
    [[nodiscard]] const Points& error() const { return iteration_.error; }

  private:
    void number_own(std::vector<Index>& kinds);
    void number_remote(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& kinds);
    void list_neighbours(std::span<const Index> kinds, const Executor& exec);
    void find_senses(const PolygonMesh& mesh, const Topology& topology);
    void share_rows();
    void stiffen(const Executor& exec);
    template <class Value>
    double add_up(const Executor& exec, Value&& value);
    [[nodiscard]] Point product(Index i) const;

    /// The numbers of the vertices of Γ.
    struct Numbering {
        /// #sub-meshes + 1: the lowest number of a vertex that each sub-mesh numbers; then the number of all vertices.
        std::vector<Index> first{0};
        /// Per vertex, its index in the interface of the sub-mesh that numbers it, and its local_vertex.
        std::vector<Index> index_in_sub_mesh;
        std::vector<Index> local_vertex;
        /// The vertices that other ranks number and that are neighbours of own vertices: for each, the sub-mesh that
        /// numbers it. Their numbers on this rank follow the numbers of own vertices.
        std::vector<Index> remote;
    };
    struct Rows {
        /// Per vertex of Γ: its edge neighbours, as numbers on Γ, off_interface or fixed_vertex; and -T for each
        /// neighbour.
        IndexLists neighbours;
        std::vector<double> couplings;
        /// Per vertex of Γ, for each face around it: 1, or -1 if the face is oriented against the others. No lists if
        /// all faces are oriented alike.
        Lists<std::int8_t> senses;
        /// Per vertex of Γ: M_v and T_vv (see ErrorRow), and the sum of the row of T.
        std::vector<double> mass;
        std::vector<double> diagonal;
        std::vector<double> row_sum;
        /// Per vertex of Γ, the vertices of other ranks included: the response of the vertices beyond Γ to each
        /// neighbour along Γ.
        std::vector<double> response;
        /// #Γ by 3: the unit normals of the surface at Vᵏ, or zero.
        Points normal;
    };
    /// The vectors of conjugate gradients, each #Γ by 3; the direction has also the rows of other ranks.
    struct Iteration {
        Points residual;
        Points error;
        Points direction;
        Points product;
    };
    const Decomposition* decomposition_;
    InterfaceRanks* ranks_;
    ScaledLaplacian laplacian_;
    Numbering numbering_;
    Rows rows_;
    std::optional<SharedRows> shared_;
    SumTree tree_;
    /// Per sub-mesh of all ranks, the sum of its values.
    std::vector<double> sums_;
    Iteration iteration_;
    /// Only with Δ_P: computes the residuals at Γ that are the right-hand side (see measure_whole_rows).
    std::optional<WholeRows> whole_;
};

}  // namespace seamflow
