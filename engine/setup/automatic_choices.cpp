#include "engine/setup/automatic_choices.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solvers/laplacian/laplacian.h"

namespace seamflow {

SubdomainChoice choose_subdomains(const MeshSize& size, double time_step, const SubdomainNeeds& needs)
{
    const double width = needs.width * std::sqrt(time_step);
    const double most_by_width = std::floor(size.area / (width * width));
    const double most_by_cost = std::floor(size.vertices / static_cast<double>(needs.vertices));
    SubdomainChoice choice;
    choice.count = static_cast<Index>(std::max(1.0, std::min(most_by_width, most_by_cost)));
    choice.reason = fmt::format("{} {} chosen: ", choice.count, choice.count == 1 ? "sub-mesh" : "sub-meshes");
    if (most_by_width < most_by_cost)
        choice.reason += fmt::format("more would be narrower than {:.0f} √dt", needs.width);
    else
        choice.reason += fmt::format("about {} vertices each are fastest, and wide enough against √dt", needs.vertices);
    return choice;
}

double width_in_diffusion_lengths(double area, Index k, double time_step)
{
    return std::sqrt(area / k / time_step);
}

namespace {

/// Leaves a few hundredths of a mean edge length on most meshes, and took one to four iterations with Δ_F on regular
/// ones, up to 19 on a scan with slivers (measured: see engine/accuracy.md).
constexpr double loose_tolerance = 1e-2;
/// In squared mean edge lengths: with longer steps, what a sweep leaves comes near a mean edge length.
constexpr double longest_step_of_sweeps = 16.0;

/// Whether an option is set that means nothing to converged steps.
bool speaks_of_sweeps(const FlowOptions& options)
{
    const FlowOptions defaults;
    return options.accuracy.approach == Approach::Sweep || options.scheme != defaults.scheme ||
           options.interface != defaults.interface || is_foreign(options.resources.factorisation);
}

/// Whether sweeps would take two sub-meshes at most.
bool has_few_sub_meshes(const PolygonMesh& mesh, const FlowOptions& options)
{
    if (!options.cut.labels.empty())
        return false;
    return options.cut.subdomains > 0 ? options.cut.subdomains <= 2 : mesh.n_vertices() < 3 * needs_of_sweeps.vertices;
}

bool has_polygons(const PolygonMesh& mesh)
{
    return mesh.n_corners() != 3 * mesh.n_faces();
}

}  // namespace

ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool boundary_moves)
{
    if (options.accuracy.tolerance)
        return {options.accuracy.tolerance, ""};
    if (options.accuracy.approach == Approach::Converged || options.accuracy.approach == Approach::ConjugateGradients)
        return {loose_tolerance, ""};
    if (boundary_moves && !speaks_of_sweeps(options) && (options.cut.subdomains != 1 || !options.cut.labels.empty()))
        return {loose_tolerance, "sub-meshes that share a free boundary need it"};
    if (speaks_of_sweeps(options) || !is_symmetric(options.laplacian) || has_few_sub_meshes(mesh, options) ||
        mesh.n_faces() == 0)
        return {};
    if (options.time_step > longest_step_of_sweeps * size.mean_edge * size.mean_edge)
        return {loose_tolerance, "steps as long as these would stray in single sweeps"};
    if (options.cut.subdomains > 0 &&
        width_in_diffusion_lengths(size.area, options.cut.subdomains, options.time_step) < needs_of_sweeps.width)
        return {loose_tolerance, "in sub-meshes as narrow as these single sweeps would stray"};
    if (traits_of(options.laplacian).reach == Reach::Faces && has_polygons(mesh))
        return {loose_tolerance, "on polygons it costs no more than single sweeps"};
    return {};
}

}  // namespace seamflow
