#include "engine/sub_mesh_options.h"

#include <cmath>

#include "engine/parallel_loop.h"
#include "partition/decomposition/overlap.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/adapted_ventcell.h"
#include "solvers/conditions/robin.h"
#include "solvers/conditions/ventcell.h"
#include "solvers/interface/robin_parameter.h"

namespace seamflow {

bool predicts(const FlowOptions& options)
{
    return options.conditions == Conditions::AdaptedRobin && options.transmission == Transmission::Predicted &&
           !options.p && options.p_rule == PRule::Paper && options.p_edge == PEdge::Automatic;
}

std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, const FlowOptions& options,
                                              SolverWorkspace& workspace)
{
    const auto with = [&](std::unique_ptr<TransmissionCondition> condition) {
        return make_system(sub_mesh, options.laplacian, std::move(condition), workspace);
    };
    switch (options.conditions) {
    case Conditions::AdaptedRobin:
        break;
    case Conditions::AdaptedVentcell:
        return with(make_adapted_ventcell(sub_mesh, options.q.value()));
    case Conditions::Robin:
        return with(make_robin(sub_mesh));
    case Conditions::Ventcell:
        return with(make_ventcell(sub_mesh, options.q.value()));
    case Conditions::Schwarz:
        return make_following_system(sub_mesh, options.laplacian, workspace);
    }
    return predicts(options) ? make_predicted_system(sub_mesh, options.laplacian, workspace)
                             : with(make_adapted_robin(sub_mesh));
}

namespace {

/// With a good prediction the other side answers to what Γ adds like a half plane: with the derivative 1/√dt, so that
/// dt p = √dt would be right for smooth surfaces. Measured on twelve meshes, Δ_A and Δ_P, a little less is better.
constexpr double predicted_p_in_diffusion_lengths = 0.7;

}  // namespace

double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const FlowOptions& options)
{
    if (sub_mesh.interface.vertices.empty() || options.conditions == Conditions::Schwarz)
        return 0.0;
    if (options.p)
        return *options.p;
    if (predicts(options))
        return predicted_p_in_diffusion_lengths / std::sqrt(options.time_step);
    const double eta = options.p_rule == PRule::InverseStep ? 1.0 / options.time_step : 1.0;
    return optimal_robin_parameter(sub_mesh, positions, eta, options.p_edge);
}

bool alternates(const FlowOptions& options, std::size_t n_sub_meshes)
{
    return options.conditions != Conditions::Schwarz &&
           (options.sweep == Sweep::Alternating || (options.sweep == Sweep::Automatic && n_sub_meshes > 2));
}

bool corrects(const FlowOptions& options)
{
    return options.correction == Correction::Centroid ||
           (options.correction == Correction::Automatic &&
            (options.conditions == Conditions::AdaptedRobin || options.conditions == Conditions::AdaptedVentcell));
}

SweepPlan make_plan(const Decomposition& decomposition, const FlowOptions& options, const std::vector<Index>& rank)
{
    if (options.conditions == Conditions::Schwarz)
        return plan_overlapping_sweep(decomposition, rank);
    return is_classical(options.conditions) ? plan_mutual_sweep(decomposition, rank, run_in_parallel)
                                            : plan_sweep(decomposition, rank, run_in_parallel);
}

}  // namespace seamflow
