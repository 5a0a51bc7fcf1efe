#include "engine/sweep/sub_mesh_equations.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/overlap.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/robin_parameter.h"

namespace seamflow {

std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, std::vector<Index> twin, bool is_only,
                                              const StepSettings& settings, const InterfaceConditions& conditions,
                                              SolverWorkspace& workspace)
{
    SystemParts parts{sub_mesh,
                      std::move(twin),
                      settings.equation.laplacian,
                      settings.factors.factorisation,
                      settings.equation.terms,
                      is_only ? Executor(run_in_parallel) : Executor()};
    if (predict(conditions))
        return make_predicted_system(std::move(parts), workspace);
    if (std::holds_alternative<SchwarzConditions>(conditions))
        return make_following_system(std::move(parts), workspace);
    if (const auto* const own = std::get_if<OwnConditions>(&conditions))
        return make_system(std::move(parts), own->make(sub_mesh), workspace);
    const auto* const classical = std::get_if<ClassicalConditions>(&conditions);
    auto condition = classical != nullptr ? make_ventcell(sub_mesh, classical->q)
                                          : make_adapted_ventcell(sub_mesh, std::get<AdaptedConditions>(conditions).q);
    return make_system(std::move(parts), std::move(condition), workspace);
}

double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const InterfaceConditions& conditions,
                       double time_step)
{
    // p √dt for PredictedTransmission. There, the positions beyond Γ (the vertices that sub-meshes share) are predicted
    // for Γ at rest. If the prediction is good, only the response of the other side to a movement of Γ is missing. A
    // backward Euler step of diffusion on a half plane whose rim moves by 1 moves its points at the distance x by
    // exp(-x/√dt). The derivative at the rim has the size 1/√dt, which is p, so that p √dt = 1 would be right for
    // smooth surfaces. A little less is better on twelve meshes, measured with Laplacian::AlexaWardetzky and
    // Laplacian::PtackovaVelho.
    constexpr double p_in_diffusion_lengths = 0.7;
    if (sub_mesh.interface.vertices.empty())
        return 0.0;
    const auto parameter = [&](const auto& alternative) {
        if constexpr (requires { alternative.p; }) {
            if (const double* const given = std::get_if<double>(&alternative.p))
                return *given;
            const auto& [eta, edge] = std::get<OptimalRobin>(alternative.p);
            return optimal_robin_parameter(sub_mesh, positions, eta, edge);
        } else {
            return std::is_same_v<std::decay_t<decltype(alternative)>, PredictedTransmission>
                       ? p_in_diffusion_lengths / std::sqrt(time_step)
                       : 0.0;
        }
    };
    return std::visit(parameter, conditions);
}

SweepPlan make_plan(const Decomposition& decomposition, const InterfaceConditions& conditions,
                    const std::vector<Index>& stage)
{
    if (std::holds_alternative<SchwarzConditions>(conditions))
        return plan_overlapping_sweep(decomposition, stage);
    return have_copies(conditions) ? plan_mutual_sweep(decomposition, stage, run_in_parallel)
                                   : plan_sweep(decomposition, stage, run_in_parallel);
}

}  // namespace seamflow
