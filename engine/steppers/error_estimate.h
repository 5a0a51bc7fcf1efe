#pragma once

#include <optional>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/sub_mesh_state.h"
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

    /// Reads the rows at the vertices of Γ that sub-mesh s numbers, before it accepts Vᵏ⁺¹. Different sub-meshes may do
    /// so at the same time.
    /// @param states the position in the state of s is Vᵏ; all sub-meshes around it have solved.
    /// @param workspace its `other_side` and `positions` are overwritten.
    void measure(std::vector<SubMeshState>& states, Index s, SolverWorkspace& workspace);

    /// Records the displacements of these vertices by the correction, after sub-mesh s has accepted Vᵏ⁺¹.
    void note_correction(const std::vector<SubMeshState>& states, Index s);

    /// Estimates the error of the step and adds it to that of the steps before. All ranks call this together.
    /// @param before #V by 3: Vᵏ of this rank's vertices.
    void add_step(const std::vector<SubMeshState>& states, const Points& before);

    /// The estimated largest distance of a vertex to the undecomposed flow after the last step, in units of length.
    /// Empty if it is not finite.
    [[nodiscard]] std::optional<double> largest() const { return largest_; }

    /// Saves and restores the data that the next step needs: arrays with a row for each of these vertices of the mesh.
    /// @throws InputError if the arrays do not fit.
    [[nodiscard]] std::vector<Index> vertices() const;
    void save(StepMemory& memory) const;
    void restore(StepMemoryReader& memory);

  private:
    [[nodiscard]] const Points& joined(const std::vector<SubMeshState>& states, Index s, Points& mean) const;
    [[nodiscard]] const Points& stiffness_at(const SubMeshState& state, Points& first) const;
    void note_attachment(const FlowTerms& terms);
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
    /// Only with an attachment: #Γ: dt w; and #Γ by 3: V⁰.
    std::vector<double> attached_;
    Points attached_to_;
    /// Whether every sub-mesh has its own copy of Γ.
    bool has_copies_;
    InterfaceRanks* ranks_;
    ErrorEquation equation_;
    /// Each #Γ by 3: the correction of this step; and the differences left after all steps, of displacements by
    /// corrections, and of errors of sweeps.
    Points correction_;
    Points corrected_;
    Points swept_;
    std::optional<double> largest_;
    /// Only with Δ_P, #V by 3: Vᵏ⁺¹ as solved, and Vᵏ if other ranks know part of it.
    Points solved_;
    Points before_;
    std::vector<std::vector<Index>> remote_rows_;
};

}  // namespace seamflow
