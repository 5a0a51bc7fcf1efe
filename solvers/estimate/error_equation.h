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
#include "solvers/interface/interface_peers.h"
#include "solvers/interface/interface_sums.h"
#include "solvers/interface/shared_rows.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The equation T e = r for the error of a decomposed step on Γ (see ErrorRow), one row per vertex of Γ. Peers solve it
/// together, each with its own sub-meshes' rows. The bits depend neither on the loop nor on the distribution.
class ErrorEquation {
  public:
    /// @param decomposition, peers must outlive this. Sub-meshes do not overlap; those of other peers are fragments
    ///        (see decompose_part), and then not for Δ_P.
    ErrorEquation(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                  const ScaledLaplacian& laplacian, InterfacePeers& peers, const Executor& exec = run_serially);

    /// Number of this peer's vertices on Γ, numbered sub-mesh by sub-mesh, each by the lowest that has it.
    [[nodiscard]] Index size() const { return static_cast<Index>(rows_.diagonal.size()); }

    /// The first number of a sub-mesh; for s = #sub-meshes the number of all.
    [[nodiscard]] Index first(Index s) const { return numbering_.first[s]; }

    /// The local index of a vertex in the sub-mesh that numbers it.
    [[nodiscard]] Index local_vertex(Index i) const { return numbering_.local_vertex[i]; }

    /// Fills in the rows of a sub-mesh's own part of Γ. Different sub-meshes may do so at the same time.
    /// @param before, after #local by 3, the halo included: Vᵏ, and Vᵏ⁺¹ as solved.
    /// @param stiffness_at see error_row.
    /// @param time_step dt, in length².
    void assemble(Index s, const Points& before, const Points& after, const Points& stiffness_at, double time_step);

    /// Replaces the right-hand side by that of Δ_P, whose rows reach too far for one sub-mesh to know. All peers call
    /// this together.
    /// @param before, after see WholeRows::measure.
    void measure_whole_rows(const PolygonMesh& mesh, const Topology& topology, const Points& before,
                            const Points& after, double time_step, const Executor& exec);

    /// Adds a vertex's attachment to V⁰.
    /// @param weight dt w. @param distance of Vᵏ⁺¹ from V⁰, as solved.
    void attach(Index i, double weight, const Point& distance)
    {
        const double entry = weight * rows_.mass[i];
        rows_.diagonal[i] += entry;
        rows_.row_sum[i] += entry;
        iteration_.residual.row(i) += entry * distance;
    }

    /// Adds to the right-hand side a displacement of single vertices of Γ that the step spreads.
    void add_displacement(Index i, const Point& d) { iteration_.residual.row(i) += rows_.mass[i] * d; }

    /// The same for an error that dies away from Γ, so that it returns unchanged where smooth along Γ, and smoothed
    /// where rough.
    void add_error(Index i, const Point& d) { iteration_.residual.row(i) += rows_.row_sum[i] * d; }

    /// Unit normal of the surface at Vᵏ; zero where it has none.
    [[nodiscard]] Point normal(Index i) const { return rows_.normal.row(i); }

    /// Solves to two digits; may be called once after the rows have been filled in. All peers call this together.
    void solve(const Executor& exec);

    /// #Γ by 3, in units of length: not finite where the rows are not.
    [[nodiscard]] const Points& error() const { return iteration_.error; }

  private:
    void number_own(std::vector<Index>& kinds);
    void number_foreign(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& kinds);
    void list_neighbours(std::span<const Index> kinds, const Executor& exec);
    void find_senses(const PolygonMesh& mesh, const Topology& topology);
    void share_rows();
    void stiffen(const Executor& exec);
    template <class Value>
    double add_up(const Executor& exec, Value&& value);
    [[nodiscard]] Point product(Index i) const;

    /// The vertices of Γ.
    struct Numbering {
        /// Per sub-mesh, and one more.
        std::vector<Index> first{0};
        /// Per vertex, its index in the interface of its sub-mesh, and see local_vertex.
        std::vector<Index> index_in_sub_mesh;
        std::vector<Index> local_vertex;
        /// The sub-meshes by which other peers number neighbours of these vertices. The numbers of such neighbours
        /// follow the own ones.
        std::vector<Index> foreign;
    };
    struct Rows {
        /// Per vertex of Γ, its edge neighbours: numbers on Γ, or see off_interface; and -T there.
        IndexLists neighbours;
        std::vector<double> couplings;
        /// Per vertex of Γ, see error_row; no lists if all faces are oriented alike.
        Lists<std::int8_t> senses;
        std::vector<double> mass;
        std::vector<double> diagonal;
        std::vector<double> row_sum;
        /// Of the vertices beyond Γ, to each neighbour along Γ; with those of other peers.
        std::vector<double> response;
        /// #Γ by 3.
        Points normal;
    };
    /// Conjugate gradients: each #Γ by 3, the direction with rows of other peers.
    struct Iteration {
        Points residual;
        Points error;
        Points direction;
        Points product;
    };
    const Decomposition* decomposition_;
    InterfacePeers* peers_;
    ScaledLaplacian laplacian_;
    Numbering numbering_;
    Rows rows_;
    std::optional<SharedRows> shared_;
    SumTree tree_;
    /// Per sub-mesh of all peers, the value to be added up.
    std::vector<double> sums_;
    Iteration iteration_;
    /// With Δ_P.
    std::optional<WholeRows> whole_;
};

}  // namespace seamflow
