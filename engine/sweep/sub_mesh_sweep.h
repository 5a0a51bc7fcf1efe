#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/setup/sweep_steps.h"
#include "engine/sweep/interface_gaps.h"
#include "engine/sweep/sub_mesh_state.h"
#include "engine/sweep/sweep_plan.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/decomposition/decomposition.h"
#include "partition/topology.h"

namespace seamflow {

/// The sub-meshes of a sweep: all of a mesh, or those that one of several ranks knows.
struct SweepSubMeshes {
    Decomposition decomposition;
    /// #sub-meshes: their names in messages.
    std::vector<SubMeshName> names;
    /// #sub-meshes: the turn of each in a sweep forward, from 0 (see SweepPlan::stage). Those of one turn have one
    /// colour.
    std::vector<Index> stage;
    /// #sub-meshes: 1 where another rank solves the sub-mesh; empty: nowhere.
    std::vector<std::uint8_t> is_remote = {};
};

/// Cuts a mesh into the sub-meshes of a cut, and colours them.
/// @param curvature #V: ‖ΔV⁰‖, in 1/length, which decides the order of the colours; empty: as if it were 0.
/// @throws Cancelled, as all functions that take time.
SweepSubMeshes cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const SweepSteps& sweeps,
                       std::vector<double> curvature, Progress& progress);

/// The sweep of the paper, generalised from two sub-meshes to many: its parts, as functions of one sub-mesh s each.
/// Their order is that of take_step. Functions of different sub-meshes may be called at the same time, as soon as what
/// they read is there: SweepStepper has them in a task graph, and adds what is no part of the method, namely filters of
/// several solutions, ranks, the estimate of the error and limits of memory.
class SubMeshSweep {
  public:
    /// Analyses the equations of the sub-meshes, and plans which data cross Γ when.
    /// @param mesh, settings need not outlive the object. Neither the filter of the settings nor their limit of memory
    /// is used. @param workspaces of the threads that run this.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; Cancelled.
    SubMeshSweep(const PolygonMesh& mesh, SweepSubMeshes sub_meshes, const StepSettings& settings,
                 const SweepSteps& sweeps, Workspaces& workspaces, Progress& progress);

    SubMeshSweep(const SubMeshSweep&) = delete;
    SubMeshSweep& operator=(const SubMeshSweep&) = delete;

    [[nodiscard]] Index size() const { return static_cast<Index>(states_.size()); }
    [[nodiscard]] const Decomposition& decomposition() const { return decomposition_; }
    [[nodiscard]] const SubMeshName& name(Index s) const { return names_[s]; }
    [[nodiscard]] bool is_remote(Index s) const { return states_[s].system == nullptr; }
    [[nodiscard]] std::vector<SubMeshState>& states() { return states_; }
    [[nodiscard]] const std::vector<SubMeshState>& states() const { return states_; }
    /// The plan of the sweep forward, and, if directions alternate, that of the sweep backward.
    [[nodiscard]] const std::vector<SweepPlan>& plans() const { return plans_; }
    /// Chooses the plan of the following steps by its number; at first it is that of the sweep forward, 0.
    void set_plan(std::size_t number) { plan_ = number; }
    [[nodiscard]] std::size_t plan_number() const { return plan_; }
    [[nodiscard]] const SweepPlan& plan() const { return plans_[plan_]; }
    /// Whether sub-meshes predict the other side of Γ.
    [[nodiscard]] bool predicts() const { return predicts_; }

    /// Fetches Vᵏ of the halo, and with copies of Γ those of other sub-meshes, and assembles A(Vᵏ).
    SubMeshSystem::Assembled assemble(Index s, SolverWorkspace& workspace);

    /// A = L U. @param memory must outlive the factor.
    void factorise(Index s, const SubMeshSystem::Assembled& equations, FactorMemory& memory,
                   SolverWorkspace& workspace);

    /// Solves with Γ fixed at Vᵏ. For sub-meshes that follow another one anywhere on Γ, if sub-meshes predict.
    void predict(Index s, SolverWorkspace& workspace);

    /// Fetches the predictions of the sub-meshes beyond Γ into the condition, where this sub-mesh leads.
    void use_predictions(Index s, SolverWorkspace& workspace);

    /// Fetches Vᵏ⁺¹ where the sub-mesh follows another on Γ, takes Vᵏ where it follows none, and solves. With copies of
    /// Γ it fetches the copies and the halo instead: Vᵏ⁺¹ from sub-meshes of an earlier turn, and Vᵏ from those of a
    /// later turn; where a vertex has several other copies, their mean is used.
    void solve(Index s, SolverWorkspace& workspace);

    /// Fetches the solutions of the halo, once all adjacent sub-meshes have solved; where sub-meshes overlap, those of
    /// all vertices that only other sub-meshes had before they grew into each other.
    void receive_solutions(Index s);

    /// Accepts Vᵏ⁺¹. If the sweep corrects, vertices of Γ move to the centroids of their edge neighbours (paper, eq.
    /// 28); every sub-mesh at a vertex finds the same bits.
    void accept(Index s);

    /// Joins the positions of the sub-meshes; copies of Γ are represented by their mean.
    void join();

    /// #V by 3: the positions at the last join, at first those of the mesh.
    [[nodiscard]] const Points& positions() const { return positions_; }
    /// The same, to be changed; the sub-meshes fetch them by fetch_positions.
    [[nodiscard]] Points& positions() { return positions_; }
    /// Copies the positions of the whole mesh to a sub-mesh.
    void fetch_positions(Index s);

    /// The gaps between copies of Γ at the last join; null if sub-meshes share Γ.
    [[nodiscard]] const InterfaceGaps* gaps() const { return gaps_ ? &*gaps_ : nullptr; }

  private:
    Decomposition decomposition_;
    std::vector<SubMeshName> names_;
    std::vector<SubMeshState> states_;
    std::vector<SweepPlan> plans_;
    std::size_t plan_ = 0;
    double time_step_;
    bool predicts_;
    bool corrects_;
    Points positions_;
    /// Only with the classical conditions.
    std::optional<InterfaceGaps> gaps_;
};

/// Takes a step of the sweep, one sub-mesh after the other, of which no other rank has any. All factors live at once.
/// SweepStepper takes the same step with all threads, to the same bits where BLAS has one thread (see Workers).
/// @throws ComputationError naming the sub-mesh if its equations are singular or not finite.
void take_step(SubMeshSweep& sweep, SolverWorkspace& workspace);

}  // namespace seamflow
