#include "engine/setup/sub_mesh_options.h"

#include <cmath>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/overlap.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/robin_parameter.h"

namespace seamflow {

std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, std::vector<Index> twin, bool is_only,
                                              const FlowOptions& options, const FlowTerms& terms,
                                              SolverWorkspace& workspace)
{
    SystemParts parts{sub_mesh,
                      std::move(twin),
                      laplacian_of(options),
                      options.resources.factorisation,
                      terms,
                      is_only ? Executor(run_in_parallel) : Executor()};
    const auto with = [&](std::unique_ptr<TransmissionCondition> condition) {
        return make_system(std::move(parts), std::move(condition), workspace);
    };
    switch (options.interface.conditions) {
    case Conditions::AdaptedRobin:
        break;
    case Conditions::AdaptedVentcell:
        return with(make_adapted_ventcell(sub_mesh, options.interface.q.value()));
    case Conditions::Robin:
        return with(make_ventcell(sub_mesh));
    case Conditions::Ventcell:
        return with(make_ventcell(sub_mesh, options.interface.q.value()));
    case Conditions::Schwarz:
        return make_following_system(std::move(parts), workspace);
    }
    return predicts(options) ? make_predicted_system(std::move(parts), workspace)
                             : with(make_adapted_ventcell(sub_mesh));
}

namespace {

/// p √dt with predictions. With a good prediction the other side responds to a further movement of Γ like a half plane:
/// the derivative is 1/√dt, so that dt p = √dt would be right for smooth surfaces. Measured on twelve meshes, Δ_A and
/// Δ_P, a little less is better.
constexpr double predicted_p_in_diffusion_lengths = 0.7;

}  // namespace

double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const FlowOptions& options)
{
    if (sub_mesh.interface.vertices.empty() || options.interface.conditions == Conditions::Schwarz)
        return 0.0;
    if (options.interface.p)
        return *options.interface.p;
    if (predicts(options))
        return predicted_p_in_diffusion_lengths / std::sqrt(options.time_step);
    const double eta = options.interface.p_rule == PRule::InverseStep ? 1.0 / options.time_step : 1.0;
    return optimal_robin_parameter(sub_mesh, positions, eta, options.interface.p_edge);
}

bool alternates(const FlowOptions& options, std::size_t n_sub_meshes)
{
    return options.interface.conditions != Conditions::Schwarz &&
           (options.interface.sweep == Sweep::Alternating ||
            (options.interface.sweep == Sweep::Automatic && n_sub_meshes > 2));
}

bool corrects(const FlowOptions& options)
{
    return options.interface.correction == Correction::Centroid ||
           (options.interface.correction == Correction::Automatic &&
            (options.interface.conditions == Conditions::AdaptedRobin ||
             options.interface.conditions == Conditions::AdaptedVentcell));
}

SweepPlan make_plan(const Decomposition& decomposition, const FlowOptions& options, const std::vector<Index>& stage)
{
    if (options.interface.conditions == Conditions::Schwarz)
        return plan_overlapping_sweep(decomposition, stage);
    return is_classical(options.interface.conditions) ? plan_mutual_sweep(decomposition, stage, run_in_parallel)
                                                      : plan_sweep(decomposition, stage, run_in_parallel);
}

}  // namespace seamflow
