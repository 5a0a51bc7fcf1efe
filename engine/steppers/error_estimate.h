#pragma once

#include <optional>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/sub_mesh_state.h"
#include "partition/decomposition/decomposition.h"
#include "partition/topology.h"
#include "solvers/estimate/error_equation.h"
#include "solvers/interface/interface_peers.h"

namespace seamflow {

/// How far a flow in sub-meshes is from the undecomposed one, estimated without it.
///
/// Given Γ, the interiors obey the undecomposed step exactly (except for Δ_P, see ErrorEquation). The residual of that
/// step's rows on Γ gives the error e of the sweep by an equation on Γ alone; the correction of Γ adds its own
/// displacement, which is known. Steps add up as vectors on Γ: the flow carries tangential differences along and
/// smooths normal ones. Away from Γ the error of a step decays, so that it is largest on Γ.
///
/// With a low-pass filter this is the error of the first solution, and of the correction.
///
/// Belongs to the arena in which it is used. Peers estimate together, each for its own sub-meshes. The bits depend
/// neither on the number of threads nor on which peer has what.
class ErrorEstimate {
  public:
    /// @param decomposition, mesh, topology, peers must outlive this; see ErrorEquation.
    ErrorEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                  const FlowOptions& options, InterfacePeers& peers);

    /// Per sub-mesh of another peer, the local indices of further vertices that its state must hold, with Vᵏ and Vᵏ⁺¹
    /// as solved; empty if there are none.
    [[nodiscard]] const std::vector<std::vector<Index>>& foreign_rows() const { return foreign_rows_; }

    /// Takes over the rows of a sub-mesh's own part of Γ, before it accepts Vᵏ⁺¹. Different sub-meshes may do so at the
    /// same time.
    /// @param states that of s has Vᵏ as its position; all around have solved.
    /// @param workspace its `other_side` and `positions` are overwritten.
    void measure(std::vector<SubMeshState>& states, Index s, SolverWorkspace& workspace);

    /// Notes how far the sub-mesh's own part of Γ was moved when it accepted Vᵏ⁺¹.
    void note_correction(const std::vector<SubMeshState>& states, Index s);

    /// Estimates the error of the step and adds it to that of the steps before. All peers call this together.
    /// @param before #V by 3: Vᵏ of this peer's vertices.
    void add_step(const std::vector<SubMeshState>& states, const Points& before);

    /// Estimated largest distance of a vertex to the undecomposed flow after the last step, in units of length. Empty
    /// where that is not finite.
    [[nodiscard]] std::optional<double> largest() const { return largest_; }

    /// Saves and restores what the next step needs: arrays with a row for each of these vertices of the mesh.
    /// @throws InputError if it does not fit.
    [[nodiscard]] std::vector<Index> vertices() const;
    void save(StepMemory& memory) const;
    void restore(StepMemoryReader& memory);

  private:
    [[nodiscard]] const Points& joined(const std::vector<SubMeshState>& states, Index s, Points& mean) const;
    [[nodiscard]] const Points& stiffness_at(const SubMeshState& state, Points& first) const;
    void attach(const FlowTerms& terms);
    void list_foreign_rows();
    [[nodiscard]] const Points& fill_foreign_rows(const std::vector<SubMeshState>& states, const Points& before);
    void carry_over();
    [[nodiscard]] std::optional<double> find_largest() const;

    const Decomposition* decomposition_;
    const PolygonMesh* mesh_;
    const Topology* topology_;
    Laplacian laplacian_;
    double time_step_;
    /// #V by 3: V⁰, where K is kept.
    Points first_;
    /// With an attachment, #Γ: dt w; and #Γ by 3: V⁰.
    std::vector<double> attached_;
    Points attached_to_;
    /// Whether every sub-mesh has its own copy of Γ.
    bool has_copies_;
    InterfacePeers* peers_;
    ErrorEquation equation_;
    /// Each #Γ by 3: the correction of this step, and what remains after all steps: displacements by corrections, and
    /// errors of sweeps.
    Points correction_;
    Points corrected_;
    Points swept_;
    std::optional<double> largest_;
    /// With Δ_P, #V by 3: Vᵏ⁺¹ as solved, and Vᵏ where other peers have something of it.
    Points solved_;
    Points before_;
    std::vector<std::vector<Index>> foreign_rows_;
};

}  // namespace seamflow
