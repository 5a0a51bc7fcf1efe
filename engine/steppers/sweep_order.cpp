#include "engine/steppers/sweep_order.h"

#include <algorithm>
#include <numeric>

#include "engine/tasks/parallel_executor.h"
#include "partition/cut/colouring.h"

namespace seamflow {

namespace {

/// Σ‖ΔV‖ over the sub-mesh's own interior.
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

/// The place of each number in an order.
std::vector<Index> inverse(const std::vector<Index>& order)
{
    std::vector<Index> places(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        places[order[i]] = static_cast<Index>(i);
    return places;
}

}  // namespace

std::vector<Index> assign_stages(const Decomposition& decomposition, Colouring colouring,
                                 const std::vector<double>& curvature)
{
    if (colouring == Colouring::Label)
        return ascending(decomposition.sub_meshes.size());
    return assign_stages(decomposition.adjacency, colouring, total_curvatures(decomposition, curvature));
}

std::vector<double> total_curvatures(const Decomposition& decomposition, const std::vector<double>& curvature)
{
    std::vector<double> totals(decomposition.sub_meshes.size());
    for_each(run_in_parallel, static_cast<Index>(totals.size()),
             [&](Index s) { totals[s] = total_curvature(decomposition.sub_meshes[s], curvature); });
    return totals;
}

std::vector<Index> assign_stages(const std::vector<std::vector<Index>>& adjacency, Colouring colouring,
                                 const std::vector<double>& totals)
{
    std::vector<Index> stage = ascending(adjacency.size());
    if (colouring == Colouring::Label)
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

Index least_window(const SweepPlan& plan, const std::vector<Index>& order)
{
    const std::vector<Index> places = inverse(order);
    // Per sub-mesh, the last place that must be factorised before it can be solved.
    std::vector<Index> last = places;
    std::vector<Index> by_stage = ascending(plan.stage.size());
    std::stable_sort(by_stage.begin(), by_stage.end(), [&](Index s, Index t) { return plan.stage[s] < plan.stage[t]; });
    Index window = 0;
    for (const Index s : by_stage) {
        for (const Transfer& prediction : plan.predictions[s])
            last[s] = std::max(last[s], places[prediction.from]);
        for (const auto* transfers : {&plan.traces[s], &plan.copies[s]})
            for (const Transfer& transfer : *transfers)
                if (plan.stage[transfer.from] < plan.stage[s])
                    last[s] = std::max(last[s], last[transfer.from]);
        window = std::max(window, last[s] - places[s] + 1);
    }
    return window;
}

}  // namespace seamflow
