#include "engine/choose_tolerance.h"

#include <cmath>

#include "engine/choose_subdomains.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

/// Leaves a few hundredths of a mean edge length on most meshes, and took one to four iterations with Δ_F on regular
/// ones, up to 34 on a scan with slivers (measured: see README, Accuracy).
constexpr double loose_tolerance = 1e-2;
/// In squared mean edge lengths: with longer steps, what a sweep leaves comes near a mean edge length.
constexpr double longest_step_of_sweeps = 16.0;

/// Whether an option is set that means nothing to converged steps.
bool speaks_of_sweeps(const FlowOptions& options)
{
    const FlowOptions defaults;
    return options.approach == Approach::Sweep || options.scheme != defaults.scheme ||
           options.conditions != defaults.conditions || options.transmission != defaults.transmission || options.p ||
           options.p_rule != defaults.p_rule || options.p_edge != defaults.p_edge || options.q ||
           options.sweep != defaults.sweep || options.correction != defaults.correction ||
           options.coloring != defaults.coloring;
}

/// Whether sweeps would take two sub-meshes at most.
bool has_few_sub_meshes(const PolygonMesh& mesh, const FlowOptions& options)
{
    if (!options.labels.empty())
        return false;
    return options.subdomains > 0 ? options.subdomains <= 2 : mesh.n_vertices() < 3 * needs_of_sweeps.vertices;
}

bool has_polygons(const PolygonMesh& mesh)
{
    return mesh.n_corners() != 3 * mesh.n_faces();
}

}  // namespace

ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool boundary_moves)
{
    if (options.tolerance)
        return {options.tolerance, ""};
    if (boundary_moves && !speaks_of_sweeps(options) && (options.subdomains != 1 || !options.labels.empty()))
        return {loose_tolerance, "sub-meshes that share a free boundary need it"};
    if (speaks_of_sweeps(options) || !is_symmetric(options.laplacian) || has_few_sub_meshes(mesh, options) ||
        mesh.n_faces() == 0)
        return {};
    if (options.time_step > longest_step_of_sweeps * size.mean_edge * size.mean_edge)
        return {loose_tolerance, "steps as long as these would stray in single sweeps"};
    if (options.subdomains > 0 &&
        width_in_diffusion_lengths(size.area, options.subdomains, options.time_step) < needs_of_sweeps.width)
        return {loose_tolerance, "in sub-meshes as narrow as these single sweeps would stray"};
    if (traits_of(options.laplacian).reach == Reach::Faces && has_polygons(mesh))
        return {loose_tolerance, "on polygons it costs no more than single sweeps"};
    return {};
}

}  // namespace seamflow
