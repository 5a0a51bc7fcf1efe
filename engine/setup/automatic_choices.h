#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/measure/mesh_size.h"
#include "engine/options/flow_options.h"
#include "engine/setup/cost_model.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Decisions that a flow makes where its options leave them open.
namespace seamflow {

/// The sizes that sub-meshes need for a kind of step.
struct SubdomainNeeds {
    /// The best number of vertices: sub-meshes of about this size have the least setup and step times per vertex, and a
    /// million vertices make enough sub-meshes to keep 64 threads busy.
    Index vertices;
    /// The least width, in √dt: with narrower sub-meshes the flow drifts away from the undecomposed one, or converged
    /// steps take more and more iterations.
    double width;
};

inline constexpr SubdomainNeeds needs_of_sweeps{2'500, 10.0};
/// The needs of unsymmetric Laplacians, whose factors grow faster with sub-mesh size.
inline constexpr SubdomainNeeds needs_of_unsymmetric_sweeps{1'000, 10.0};
inline constexpr SubdomainNeeds needs_of_converged_steps{2'000, 2.0};

/// The needs of the sub-meshes of a flow.
/// @param converged whether steps are converged.
const SubdomainNeeds& needs_of(Laplacian laplacian, bool converged);

/// A number of sub-meshes and the reason for it.
struct SubdomainChoice {
    Index count = 1;
    std::string reason;
};

/// Chooses sub-meshes of the best size, but on average no narrower than required.
SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs);

/// The average width of k sub-meshes of a mesh of this area, in √dt: the square root of their average area.
double width_in_diffusion_lengths(double area, Index k, double time_step);

/// Whether steps are converged, and the reason if the options leave it open.
struct ToleranceChoice {
    /// The tolerance of converged steps; empty: steps are sweeps.
    std::optional<double> tolerance;
    /// Empty if the options decide.
    std::string reason;
};

/// The tolerance of the options, if they have one. If the options leave the use of sub-meshes open, and no option asks
/// for sweeps, steps are also converged, loosely, if a sweep would drift from the undecomposed step or cost more. They
/// are also converged if vertices on the boundary or at junctions move, because sub-meshes can share such vertices only
/// in converged steps.
/// @param rim_moves whether any such vertex moves (see moving_rim).
ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool rim_moves = false);

/// The condition under which vertices at junctions would move, such as "In converged steps"; empty if they move, or are
/// to be fixed.
std::string_view need_of_junctions(const FlowOptions& options);

/// The choice of the way in which steps are taken: Sweep, Converged, ConjugateGradients or Undecomposed.
struct ApproachChoice {
    Approach approach = Approach::Sweep;
    /// The tolerance; empty: steps are not converged.
    std::optional<double> tolerance = {};
    /// A sentence; empty if the options decide.
    std::string reason = {};
    /// All ways that were considered, cheapest first; empty if there was no choice. And the input of their costs.
    std::vector<PredictedCost> costs = {};
    FlowSize size = {};
};

/// Whether ranks share the steps (see FlowControl::ranks).
enum class Sharing { None, Ranks };

/// The approach of the options. With Approach::Automatic, unless options concern sub-meshes or sweeps: the cheapest way
/// (see predict_cost) among those whose error is at most that of automatically chosen sub-meshes.
/// @param topology with the vertices that move.
/// @param earlier the choice for the steps that the flow continues from, maybe for fewer of them: it is kept.
/// @param sharing with ranks, Approach::Automatic takes steps in sub-meshes.
ApproachChoice choose_approach(const PolygonMesh& mesh, const Topology& topology, const MeshSize& size,
                               const FlowOptions& options, std::optional<Approach> earlier = {},
                               Sharing sharing = Sharing::None);

/// The choice of conjugate gradients, which factorise nothing, for an automatic approach whose factors do not fit into
/// the memory limit.
/// @param options as given.
/// @returns empty if the options name an approach, or exclude conjugate gradients.
std::optional<ApproachChoice> choose_without_factors(const MeshSize& size, const FlowOptions& options);

}  // namespace seamflow
