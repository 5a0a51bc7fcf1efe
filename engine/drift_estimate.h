#pragma once

#include <vector>

#include "engine/sub_mesh_state.h"
#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"
#include "partition/loop.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// How far the flow in sub-meshes is from the undecomposed one, estimated without it.
///
/// Given Γ, the interiors obey the undecomposed step exactly. What remains of its rows on Γ after the sweep, the
/// residual, and an equation on Γ alone (see IndicatorRow) give the error e of the sweep; the correction of Γ adds its
/// own displacement δ to it, which is known. Steps add up as vectors on Γ: the flow carries tangential differences
/// along and smooths normal ones.
///
/// Belongs to the arena in which it is used. The bits do not depend on the number of threads, and steps allocate
/// nothing.
class DriftEstimate {
  public:
    /// @param decomposition must outlive this; its sub-meshes do not overlap.
    DriftEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, double time_step);

    /// Evaluates the rows of a sub-mesh's own part of Γ, where it has not yet accepted Vᵏ⁺¹. Different sub-meshes may
    /// do so at the same time.
    /// @param state its position is Vᵏ, its solution has the halo filled in.
    void measure(Index s, const SubMeshState& state);

    /// Notes how far the sub-mesh's own part of Γ was moved when it accepted Vᵏ⁺¹.
    void note_correction(Index s, const SubMeshState& state);

    /// Evaluates the rows of Δ_P around Γ, which reach too far for one sub-mesh to know; to be called before add_step.
    /// @param before, after #V by 3: Vᵏ, and Vᵏ⁺¹ as solved.
    void measure_around(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                        const Loop& loop);

    /// Estimates the error of the step and adds it to that of the steps before.
    void add_step(const Loop& loop);

    /// Estimated largest distance of a vertex to the undecomposed flow, in units of length.
    [[nodiscard]] double largest() const { return largest_; }

  private:
    [[nodiscard]] Index size() const { return static_cast<Index>(diagonal_.size()); }
    template <class Value>
    double add_up(const Loop& loop, Value&& value);
    void list_surroundings(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> kind);
    void stiffen(const Loop& loop);
    void carry_over(const Loop& loop);
    void solve(const Loop& loop);
    [[nodiscard]] Point product(Index i) const;

    const Decomposition* decomposition_;
    Laplacian laplacian_;
    double time_step_;
    double largest_ = 0.0;
    /// Γ is numbered sub-mesh by sub-mesh, each vertex by the one that owns it: the first number of each.
    std::vector<Index> first_;
    /// Per vertex of Γ, its index in its owner's interface.
    std::vector<Index> index_in_owner_;
    /// Per vertex of Γ, its edge neighbours: numbers on Γ, or see off_interface; -T there.
    IndexLists neighbours_;
    std::vector<double> couplings_;
    std::vector<double> mass_;
    std::vector<double> diagonal_;
    std::vector<double> yielded_;
    /// Each #Γ by 3.
    Points normal_;
    Points residual_;
    Points error_;
    Points direction_;
    Points product_;
    /// What all steps so far have left: errors of sweeps, and displacements by corrections.
    Points swept_;
    Points corrected_;
    /// With Δ_P, the vertices of Γ and those around it, as indices into the whole mesh: those of faces that touch Γ, where
    /// the rows of a sub-mesh are not those of the whole mesh. How many of Γ share a face with each, and per vertex of Γ
    /// those with which it shares one.
    std::vector<Index> vertices_;
    std::vector<Index> surroundings_;
    std::vector<Index> n_shared_;
    IndexLists around_;
    /// #surroundings by 3.
    Points residual_around_;
    /// Per block of Γ.
    std::vector<double> of_block_;
};

}  // namespace seamflow
