#pragma once

#include <optional>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/state/step_memory.h"
#include "engine/sweep/sub_mesh_state.h"
#include "partition/decomposition/decomposition.h"
#include "partition/topology.h"
#include "solvers/estimate/error_equation.h"
#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// Estimates how far a flow in sub-meshes is from the undecomposed flow, without computing the latter.
///
/// Given Γ, the interiors obey the undecomposed step exactly (except for Δ_P, see ErrorEquation). The residual of that
/// step's rows on Γ gives the error e of the sweep by an equation on Γ alone; the correction of Γ adds its own
/// displacement, which is known. Errors of steps add up as vectors on Γ: tangential differences are carried along by
/// the flow, normal differences are smoothed. Away from Γ the error of a step decays, so that it is largest on Γ.
///
/// With a low-pass filter the estimate is the error of the first solution, and of the correction.
///
/// Belongs to the arena in which it is used. Ranks estimate together, each for its own sub-meshes. The bits depend
/// neither on the number of threads nor on which rank owns which sub-mesh.
class ErrorEstimate {
  public:
    /// @param decomposition, mesh, topology, ranks must outlive this; see ErrorEquation.
    /// @param has_copies whether every sub-mesh has its own copy of Γ.
    ErrorEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                  const StepEquation& equation, bool has_copies, InterfaceRanks& ranks);

    /// Per sub-mesh of another rank: the local indices of further vertices that its state must hold, with Vᵏ and Vᵏ⁺¹
    /// as solved. Empty if no rank needs any.
    [[nodiscard]] const std::vector<std::vector<Index>>& remote_rows() const { return remote_rows_; }

    /// Computes the residual of the undecomposed step at the vertices of Γ that sub-mesh s numbers (see ErrorEquation),
    /// before s accepts Vᵏ⁺¹. May be called for different sub-meshes at the same time.
    /// @param states the position in the state of s is Vᵏ; all sub-meshes around it have solved, and s has received
    /// their solutions.
    /// @param workspace its `other_side` and `positions` are overwritten.
    void measure(const std::vector<SubMeshState>& states, Index s, SolverWorkspace& workspace);

    /// Records the displacements, by the correction, of the vertices that sub-mesh s numbers, after s has accepted
    /// Vᵏ⁺¹.
    void note_correction(const std::vector<SubMeshState>& states, Index s);

    /// Estimates the error of the step and adds it to that of the steps before. All ranks call this together.
    /// @param before #V by 3: Vᵏ of this rank's vertices.
    void add_step(const std::vector<SubMeshState>& states, const Points& before);

    /// The estimated largest distance of a vertex to the undecomposed flow after the last step, in units of length.
    /// Empty if it is not finite.
    [[nodiscard]] std::optional<double> largest() const { return largest_; }

    /// The vertices of Γ that this rank numbers, as vertices of the mesh: one for each row of the arrays that `save`
    /// writes.
    [[nodiscard]] std::vector<Index> vertices() const;
    /// Appends the arrays that the next step needs.
    void save(StepMemory& memory) const;
    /// @throws InputError if the arrays do not fit.
    void restore(StepMemoryReader& memory);

  private:
    [[nodiscard]] const Points& joined(const std::vector<SubMeshState>& states, Index s, Points& storage) const;
    [[nodiscard]] const Points& stiffness_positions(const SubMeshState& state, Points& storage) const;
    void store_attachment(const FlowTerms& terms);
    void list_remote_rows();
    [[nodiscard]] const Points& fill_remote_rows(const std::vector<SubMeshState>& states, const Points& before);
    void carry_over();
    [[nodiscard]] std::optional<double> find_largest() const;

    const Decomposition* decomposition_;
    const PolygonMesh* mesh_;
    const Topology* topology_;
    Laplacian laplacian_;
    double time_step_;
    /// #V by 3: V⁰, if K is kept.
    Points initial_;
    /// Only with an attachment (see FlowTerms): #Γ: dt w; and #Γ by 3: V⁰.
    std::vector<double> attached_;
    Points attached_to_;
    /// Whether every sub-mesh has its own copy of Γ.
    bool has_copies_;
    InterfaceRanks* ranks_;
    ErrorEquation equation_;
    /// #Γ by 3: the displacements by the correction of this step.
    Points correction_;
    /// #Γ by 3: the remainders, after the steps so far, of all displacements by corrections.
    Points corrected_;
    /// #Γ by 3: the remainders, after the steps so far, of the errors of all sweeps.
    Points swept_;
    std::optional<double> largest_;
    /// Only with Δ_P (Laplacian::PtackovaVelho), #V by 3: Vᵏ⁺¹ as solved, and Vᵏ if other ranks know part of it.
    Points solved_;
    Points before_;
    std::vector<std::vector<Index>> remote_rows_;
};

}  // namespace seamflow
