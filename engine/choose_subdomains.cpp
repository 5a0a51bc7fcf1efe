#include "engine/choose_subdomains.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel_loop.h"
#include "partition/loop.h"
#include "solvers/geometry.h"

namespace seamflow {

namespace {

/// Factorising and solving costs least per vertex in blocks of this size or less; smaller ones have more interface for
/// no gain.
constexpr double vertices_per_sub_mesh = 2'500.0;

double total_area(const PolygonMesh& mesh)
{
    return sum(run_in_parallel, mesh.n_faces(), [&](Index f) { return area(mesh.face(f), mesh.vertices); });
}

}  // namespace

SubdomainChoice choose_subdomains(const PolygonMesh& mesh, double time_step)
{
    const double width = good_width_in_diffusion_lengths * std::sqrt(time_step);
    const double most_by_width = std::floor(total_area(mesh) / (width * width));
    const double most_by_cost = std::floor(mesh.n_vertices() / vertices_per_sub_mesh);
    SubdomainChoice choice;
    choice.count = static_cast<Index>(std::max(1.0, std::min(most_by_width, most_by_cost)));
    const std::string number = std::to_string(choice.count) + (choice.count == 1 ? " sub-mesh" : " sub-meshes");
    if (most_by_width < most_by_cost)
        choice.reason =
            number + " chosen: more would be narrower than 10 √dt, where the result drifts from the undecomposed flow";
    else
        choice.reason = number + " chosen: blocks of about 2,500 vertices are cheap, and wide enough against √dt";
    return choice;
}

double width_in_diffusion_lengths(const PolygonMesh& mesh, Index k, double time_step)
{
    return std::sqrt(total_area(mesh) / k / time_step);
}

}  // namespace seamflow
