#include "engine/steppers/sweep_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "partition/cut/colouring.h"

namespace seamflow {

namespace {

/// Σ‖ΔV‖ over the vertices of a sub-mesh that are neither fixed nor on Γ, in 1/length.
double total_curvature(const SubMesh& sub_mesh, const std::vector<double>& curvature)
{
    if (curvature.empty())
        return 0.0;
    std::vector<bool> counts(sub_mesh.n_vertices, true);
    for (const Index v : sub_mesh.interface.vertices)
        counts[v] = false;
    double sum = 0.0;
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        if (counts[v] && sub_mesh.fixed[v] == 0)
            sum += curvature[sub_mesh.local_to_global[v]];
    return sum;
}

std::vector<Index> ascending(std::size_t n)
{
    std::vector<Index> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// The index of each number in an order.
std::vector<Index> inverse(const std::vector<Index>& order)
{
    std::vector<Index> indices(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        indices[order[i]] = static_cast<Index>(i);
    return indices;
}

/// Calls visit(t) for each sub-mesh t that solves before s in the sweep and whose Vᵏ⁺¹ on Γ is then used by s: t leads,
/// and s follows.
template <class Visit>
void for_each_leader(const SweepPlan& plan, Index s, Visit&& visit)
{
    for (const auto* transfers : {&plan.traces[s], &plan.copies[s]})
        for (const Transfer& transfer : *transfers)
            if (plan.stage[transfer.from] < plan.stage[s])
                visit(transfer.from);
}

/// The sub-meshes in the order of the sweep.
std::vector<Index> by_stage(const SweepPlan& plan)
{
    std::vector<Index> sub_meshes = ascending(plan.stage.size());
    std::ranges::stable_sort(sub_meshes, {}, [&](Index s) { return plan.stage[s]; });
    return sub_meshes;
}

}  // namespace

std::vector<double> total_curvatures(const Decomposition& decomposition, const std::vector<double>& curvature)
{
    std::vector<double> totals(decomposition.sub_meshes.size());
    for_each(run_in_parallel, static_cast<Index>(totals.size()),
             [&](Index s) { totals[s] = total_curvature(decomposition.sub_meshes[s], curvature); });
    return totals;
}

std::vector<Index> assign_stages(const std::vector<std::vector<Index>>& adjacency, bool solves_in_order_of_numbers,
                                 const std::vector<double>& totals)
{
    std::vector<Index> stage = ascending(adjacency.size());
    if (solves_in_order_of_numbers)
        return stage;

    const std::vector<Index> colours = colour(adjacency);
    std::vector<double> of_colour(n_colours(colours), 0.0);
    for (std::size_t s = 0; s < colours.size(); ++s)
        of_colour[colours[s]] += totals[s];
    std::vector<Index> order = ascending(of_colour.size());
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return of_colour[a] > of_colour[b]; });
    const std::vector<Index> stage_of_colour = inverse(order);
    std::transform(colours.begin(), colours.end(), stage.begin(), [&](Index c) { return stage_of_colour[c]; });
    return stage;
}

std::vector<Index> reversed(const std::vector<Index>& stage)
{
    const Index highest = stage.empty() ? 0 : *std::max_element(stage.begin(), stage.end());
    std::vector<Index> reversed_stages(stage.size());
    std::transform(stage.begin(), stage.end(), reversed_stages.begin(), [&](Index r) { return highest - r; });
    return reversed_stages;
}

std::vector<Index> order_by_need(const SweepPlan& plan, const std::vector<Index>& order)
{
    const std::vector<Index> indices = inverse(order);
    // For each sub-mesh s, the lowest index in `order` among s and all sub-meshes that wait, directly or through
    // others, for the solution of s; and then also among those that use a prediction by the factor of s.
    std::vector<Index> first_after_solution = indices;
    std::vector<Index> sweep = by_stage(plan);
    for (auto s = sweep.rbegin(); s != sweep.rend(); ++s)
        for_each_leader(plan, *s, [&](Index leader) {
            first_after_solution[leader] = std::min(first_after_solution[leader], first_after_solution[*s]);
        });
    std::vector<Index> first_after_factor = first_after_solution;
    for (const Index s : sweep)
        for (const Transfer& prediction : plan.predictions[s])
            first_after_factor[prediction.from] =
                std::min(first_after_factor[prediction.from], first_after_solution[s]);
    std::ranges::stable_sort(sweep, {}, [&](Index s) { return first_after_factor[s]; });
    return sweep;
}

FactorWindow least_window(const SweepPlan& plan, std::vector<Index> order)
{
    const std::vector<Index> indices = inverse(order);
    // Per sub-mesh, the last index that must be factorised before it can be solved.
    std::vector<Index> last = indices;
    FactorWindow window{.order = std::move(order), .freed = by_stage(plan)};
    for (const Index s : window.freed) {
        for (const Transfer& prediction : plan.predictions[s])
            last[s] = std::max(last[s], indices[prediction.from]);
        for_each_leader(plan, s, [&](Index leader) { last[s] = std::max(last[s], last[leader]); });
    }
    std::ranges::stable_sort(window.freed, {}, [&](Index s) { return last[s]; });
    // When freed[i] is to be solved, i factors have been freed: the window must then reach to the index last[freed[i]].
    for (std::size_t i = 0; i < last.size(); ++i)
        window.size = std::max(window.size, last[window.freed[i]] - static_cast<Index>(i) + 1);
    return window;
}

}  // namespace seamflow
