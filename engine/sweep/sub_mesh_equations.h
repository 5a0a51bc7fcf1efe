#pragma once

#include <memory>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/setup/sweep_steps.h"
#include "engine/sweep/sweep_plan.h"
#include "solvers/systems/sub_mesh_system.h"

/// The parts of a sweep that its conditions on Γ decide. Γ are the vertices that several sub-meshes share; in a sweep,
/// the sub-meshes solve colour by colour, each with conditions there in place of the sub-meshes on the other side.
namespace seamflow {

/// Makes the equations of a sub-mesh.
/// @param sub_mesh must outlive the equations.
/// @param twin of the sub-mesh, kept by equations that need it.
/// @param is_only whether this is the only sub-mesh: all threads then work on it.
/// @throws ComputationError if the analysis of the equations fails.
std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, std::vector<Index> twin, bool is_only,
                                              const StepSettings& settings, const InterfaceConditions& conditions,
                                              SolverWorkspace& workspace);

/// The Robin parameter p of a sub-mesh, in 1/length: the weight of the normal derivative in its conditions on Γ (see
/// AdaptedRobin); 0 if these have none.
/// @param positions #local by 3. @param time_step dt, in length².
double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const InterfaceConditions& conditions,
                       double time_step);

/// Plans a sweep for the conditions: of overlapping sub-meshes with Schwarz's, of sub-meshes that keep their copies of
/// Γ with the classical ones, otherwise of sub-meshes of which the first to solve at a vertex of Γ determines it.
/// @param stage #sub-meshes: the turn of each in the sweep; adjacent sub-meshes have different turns.
SweepPlan make_plan(const Decomposition& decomposition, const InterfaceConditions& conditions,
                    const std::vector<Index>& stage);

}  // namespace seamflow
