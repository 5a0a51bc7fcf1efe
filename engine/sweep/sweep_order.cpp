#include "engine/sweep/sweep_order.h"

#include <algorithm>
#include <numeric>

#include "engine/tasks/parallel_executor.h"
#include "partition/cut/colouring.h"
#include "partition/index_lists.h"

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
    std::vector<Index> stage(adjacency.size());
    std::iota(stage.begin(), stage.end(), 0);
    if (solves_in_order_of_numbers)
        return stage;

    const std::vector<Index> colours = colour(adjacency);
    std::vector<double> of_colour(n_colours(colours), 0.0);
    for (std::size_t s = 0; s < colours.size(); ++s)
        of_colour[colours[s]] += totals[s];
    std::vector<Index> order(of_colour.size());
    std::iota(order.begin(), order.end(), 0);
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

}  // namespace seamflow
