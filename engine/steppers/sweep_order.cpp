#include "engine/steppers/sweep_order.h"

#include <algorithm>
#include <numeric>

#include "engine/tasks/parallel_loop.h"
#include "partition/cut/coloring.h"

namespace seamflow {

namespace {

/// Σ‖ΔV‖ over the sub-mesh's own interior.
double total_curvature(const SubMesh& sub_mesh, const std::vector<double>& curvature)
{
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

std::vector<Index> rank_sub_meshes(const Decomposition& decomposition, Coloring coloring,
                                   const std::vector<double>& curvature)
{
    std::vector<Index> rank(decomposition.sub_meshes.size());
    std::iota(rank.begin(), rank.end(), 0);
    if (coloring == Coloring::Label)
        return rank;

    const std::vector<Index> colors = color(decomposition.adjacency);
    std::vector<double> total(n_colors(colors), 0.0);
    std::vector<double> of_sub_mesh(colors.size());
    for_each(run_in_parallel, static_cast<Index>(colors.size()),
             [&](Index s) { of_sub_mesh[s] = total_curvature(decomposition.sub_meshes[s], curvature); });
    for (std::size_t s = 0; s < colors.size(); ++s)
        total[colors[s]] += of_sub_mesh[s];
    std::vector<Index> order(total.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return total[a] > total[b]; });
    std::vector<Index> rank_of_color(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        rank_of_color[order[i]] = static_cast<Index>(i);
    std::transform(colors.begin(), colors.end(), rank.begin(), [&](Index c) { return rank_of_color[c]; });
    return rank;
}

std::vector<Index> reversed(const std::vector<Index>& rank)
{
    const Index highest = rank.empty() ? 0 : *std::max_element(rank.begin(), rank.end());
    std::vector<Index> reversed_rank(rank.size());
    std::transform(rank.begin(), rank.end(), reversed_rank.begin(), [&](Index r) { return highest - r; });
    return reversed_rank;
}

}  // namespace seamflow
