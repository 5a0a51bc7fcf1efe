#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/setup/sweep_plan.h"
#include "solvers/systems/sub_mesh_system.h"

/// The settings of sub-meshes that follow from the options of a flow.
namespace seamflow {

/// Makes the equations of a sub-mesh.
/// @param sub_mesh must outlive the equations.
/// @param twin of the sub-mesh, kept by equations that need it.
/// @param is_only whether this is the only sub-mesh: all threads then work on it.
/// @throws ComputationError if the analysis of the equations fails.
std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, std::vector<Index> twin, bool is_only,
                                              const FlowOptions& options, const FlowTerms& terms,
                                              SolverWorkspace& workspace);

/// The Robin parameter of a sub-mesh, in 1/length; 0 if its conditions have none.
/// @param positions #local by 3.
double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const FlowOptions& options);

/// Whether the direction of the sweep alternates from step to step.
bool alternates(const FlowOptions& options, std::size_t n_sub_meshes);

/// Whether the vertices of Γ move to the centroids of their neighbours after a step.
bool corrects(const FlowOptions& options);

/// Plans the sweep in ascending order of `stage`.
SweepPlan make_plan(const Decomposition& decomposition, const FlowOptions& options, const std::vector<Index>& stage);

}  // namespace seamflow
