#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/measure/surface_measures.h"
#include "engine/options/flow_options.h"
#include "engine/setup/cost_model.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Choices that a flow makes where its options do not.
namespace seamflow {

/// Requirements on sub-meshes for a kind of step.
struct SubdomainNeeds {
    /// Setup and steps cost little per vertex in sub-meshes of about this size, and a million vertices make enough of
    /// them to keep 64 threads busy.
    Index vertices;
    /// In √dt: below that the flow drifts away from the undecomposed one, or converged steps take more and more
    /// iterations.
    double width;
};

inline constexpr SubdomainNeeds needs_of_sweeps{2'500, 10.0};
/// For unsymmetric Laplacians, whose factors grow faster with sub-mesh size.
inline constexpr SubdomainNeeds needs_of_unsymmetric_sweeps{1'000, 10.0};
inline constexpr SubdomainNeeds needs_of_converged_steps{2'000, 2.0};

/// Sub-mesh requirements of a flow.
/// @param converged whether steps are converged.
const SubdomainNeeds& needs_of(Laplacian laplacian, bool converged);

/// A number of sub-meshes and the reason for it.
struct SubdomainChoice {
    Index count = 1;
    std::string reason;
};

/// Sub-meshes of a size that costs little, but on average no narrower than required.
SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs);

/// Average width of k sub-meshes of a mesh of this area, the square root of their average area, in √dt.
double width_in_diffusion_lengths(double area, Index k, double time_step);

/// Whether steps are converged, and why if nobody asked for it.
struct ToleranceChoice {
    /// Empty: steps are sweeps.
    std::optional<double> tolerance;
    /// Empty where the options decide.
    std::string reason;
};

/// The tolerance of the options, if they have one. Where they leave open how sub-meshes are used, and unless another
/// option asks for sweeps, steps are also converged, loosely, where a sweep would drift from the undecomposed step or
/// cost more. They also are if the boundary moves, or vertices at junctions, which sub-meshes can share only in
/// converged steps.
/// @param rim_moves whether any such vertex moves (see moving_rim).
ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool rim_moves = false);

/// When vertices at junctions would move if they do not with these options, as in "In converged steps"; empty: they
/// move, or are to be held.
std::string_view need_of_junctions(const FlowOptions& options);

/// How steps are taken: one of Sweep, Converged, ConjugateGradients and Undecomposed.
struct ApproachChoice {
    Approach approach = Approach::Sweep;
    /// Empty: steps are not converged.
    std::optional<double> tolerance = {};
    /// A sentence; empty where the options decide.
    std::string reason = {};
    /// All ways that would do, cheapest first; empty if there was no choice. And what their costs follow from.
    std::vector<PredictedCost> costs = {};
    FlowSize size = {};
};

/// Whether ranks share the steps (see FlowControl::ranks).
enum class Sharing { None, Ranks };

/// The approach of the options. With Approach::Automatic, unless they concern sub-meshes or sweeps, the cheapest way
/// (see predict_cost) of those that come as near to the undecomposed flow as automatically chosen sub-meshes would.
/// @param topology with the vertices that move.
/// @param earlier the choice for the steps that the flow continues from, maybe for fewer of them: it is kept.
/// @param sharing with ranks, Approach::Automatic takes steps in sub-meshes.
ApproachChoice choose_approach(const PolygonMesh& mesh, const Topology& topology, const MeshSize& size,
                               const FlowOptions& options, std::optional<Approach> earlier = {},
                               Sharing sharing = Sharing::None);

/// Steps that factorise nothing, for an automatic approach whose factors do not fit into the memory limit: by conjugate
/// gradients.
/// @param options as given.
/// @returns empty where the options rule them out.
std::optional<ApproachChoice> choose_without_factors(const MeshSize& size, const FlowOptions& options);

}  // namespace seamflow
