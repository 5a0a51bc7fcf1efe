#pragma once

#include <optional>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/sub_mesh_state.h"
#include "partition/decomposition/decomposition.h"
#include "partition/topology.h"
#include "solvers/estimate/error_equation.h"

namespace seamflow {

/// How far a flow in sub-meshes is from the undecomposed one, estimated without it.
///
/// Given Γ, the interiors obey the undecomposed step exactly (but for Δ_P, see ErrorEquation). What the sweep
/// leaves of its rows on Γ, the residual, gives the error e of the sweep by an equation on Γ alone; the correction of Γ
/// adds its own displacement, which is known. Steps add up as vectors on Γ: the flow carries tangential differences
/// along and smooths normal ones. Away from Γ the error of a step dies away, so that Γ has the largest.
///
/// With a low-pass filter it is that of the first solution, and of the correction.
///
/// Belongs to the arena in which it is used. The bits do not depend on the number of threads, and steps allocate
/// nothing, but for a mean of copies with the classical conditions.
class ErrorEstimate {
  public:
    /// @param decomposition, mesh, topology must outlive this; sub-meshes that do not overlap.
    ErrorEstimate(const Decomposition& decomposition, const PolygonMesh& mesh, const Topology& topology,
                  const FlowOptions& options);

    /// Takes over the rows of a sub-mesh's own part of Γ, before it accepts Vᵏ⁺¹. Different sub-meshes may do so at the
    /// same time.
    /// @param states that of s has Vᵏ as its position; all around have solved.
    /// @param workspace its `other_side` and `positions` are overwritten.
    void measure(std::vector<SubMeshState>& states, Index s, SolverWorkspace& workspace);

    /// Notes how far the sub-mesh's own part of Γ was moved when it accepted Vᵏ⁺¹.
    void note_correction(const std::vector<SubMeshState>& states, Index s);

    /// Estimates the error of the step and adds it to that of the steps before.
    /// @param before #V by 3: Vᵏ.
    void add_step(const Points& before);

    /// Estimated largest distance of a vertex to the undecomposed flow, in units of length. Empty where that is not
    /// finite.
    [[nodiscard]] std::optional<double> largest() const;

    /// Adds what the next step needs, and takes it back.
    /// @throws InputError if it does not fit.
    void save(StepMemory& memory) const;
    void restore(StepMemoryReader& memory);

  private:
    [[nodiscard]] const Points& joined(const std::vector<SubMeshState>& states, Index s, Points& mean) const;
    [[nodiscard]] const Points& stiffness_at(const SubMeshState& state, Points& first) const;
    void attach(const FlowTerms& terms);
    void carry_over();

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
    /// Whether every sub-mesh has a copy of Γ of its own.
    bool has_copies_;
    ErrorEquation equation_;
    /// Each #Γ by 3. What the correction did in this step, and what is there after all steps: displacements by
    /// corrections, and errors of sweeps.
    Points correction_;
    Points corrected_;
    Points swept_;
    /// With Δ_P, #V by 3: Vᵏ⁺¹ as solved.
    Points solved_;
};

}  // namespace seamflow
