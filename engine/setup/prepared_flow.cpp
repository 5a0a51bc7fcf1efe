#include "engine/setup/prepared_flow.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/measure/surface_measures.h"
#include "engine/setup/moving_rim.h"
#include "engine/state/flow_identity.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// Checks the mesh, and that a state to resume from belongs to it.
/// @returns the identity of the flow; 0 if there is no state to resume from, and no observer that may ask for one.
std::uint64_t require_sound(const PolygonMesh& mesh, const FlowOptions& options, bool is_observed,
                            const FlowState* resume, Progress& progress)
{
    require_valid(mesh, progress.exec());
    progress.count();
    if (resume == nullptr && !is_observed)
        return 0;
    const std::uint64_t identity = identify(mesh, options);
    if (resume != nullptr)
        require_identity(*resume, identity);
    progress.count();
    return identity;
}

/// Whether only the faces around a region need to flow: there are strengths, no option needs the whole surface, and no
/// seam of a moving boundary could open.
bool flows_alone(const FlowOptions& options)
{
    return !options.motion.strength.empty() && !options.motion.limits.exist() && !options.motion.strict &&
           !options.report.reference && !options.report.keep_gaps && options.motion.boundary == Boundary::Fixed;
}

/// Measures what steps and reports need of the mesh before the first step.
void measure(PreparedFlow& prepared, Approach approach)
{
    const PolygonMesh& mesh = prepared.surface.mesh.mesh();
    const FlowOptions& options = prepared.options;
    // Sweeps order the colours by curvature.
    const bool is_ordering = approach == Approach::Sweep;
    // With sub-meshes, the curvature for reports is measured here, because this runs beside METIS.
    const bool is_beside_cut = options.report.measures && !takes_whole_mesh(approach);
    if (is_ordering || is_beside_cut)
        prepared.curvature = measure_curvature(mesh, prepared.surface.topology, mesh.vertices, laplacian_of(options));
    if (options.report.measures)
        prepared.meter.emplace(mesh, prepared.surface.topology);
}

}  // namespace

std::unique_ptr<PreparedFlow> prepare(PolygonMesh& mesh, FlowOptions options, bool is_observed,
                                      const FlowControl& control, Progress& progress)
{
    const FlowState* const resume = control.resume.get();
    FlowingMesh flowing(mesh);
    const std::uint64_t identity = require_sound(flowing.mesh(), options, is_observed, resume, progress);
    const std::string_view need = need_of_junctions(options);
    if (!need.empty())
        options.motion.junctions = Junctions::Hold;
    const SurfaceRequest request{.laplacian = options.laplacian,
                                 .keeps_all_faces = options.report.keep_gaps,
                                 .leaves_out_still_faces = flows_alone(options)};
    auto [surface, motion] = make_surface(std::move(flowing), std::move(options.motion), request, progress);
    options.motion = std::move(motion);
    options.cut.labels = surface.mesh.of_faces_left(options.cut.labels);
    auto prepared = std::make_unique<PreparedFlow>(PreparedFlow{
        .surface = std::move(surface), .options = std::move(options), .identity = identity, .need_of_junctions = need});
    progress.count();
    prepared->plan =
        decide(prepared->surface, prepared->options, resume != nullptr ? std::optional(resume->approach) : std::nullopt,
               control.ranks != nullptr ? Sharing::Ranks : Sharing::None, progress,
               [&](Approach approach) { measure(*prepared, approach); });
    const Topology& topology = prepared->surface.topology;
    if (std::holds_alternative<SweepSteps>(prepared->plan.way))
        require_boundary_unshared(topology, prepared->plan.cut.labels,
                                  moving_rim(prepared->surface.mesh.mesh(), topology));
    return prepared;
}

void report_to(const PreparedFlow& prepared, FlowReport& report)
{
    const FlowOptions& options = prepared.options;
    report_to(prepared.plan, prepared.surface, options, prepared.need_of_junctions, report);
    const Index n_sub_meshes = prepared.plan.cut.n_parts;
    if (n_sub_meshes > 1 && options.steps > 0 && std::holds_alternative<SweepSteps>(prepared.plan.way)) {
        const double width = width_in_diffusion_lengths(prepared.surface.size.area, n_sub_meshes, options.time_step);
        if (width < needs_of_sweeps.width)
            report.remarks.push_back(
                {"narrow sub-meshes",
                 {{"width in √dt", width}},
                 {fmt::format("The sub-meshes are narrow compared with √dt ({:.2f} √dt on average, 10 is good): the "
                              "result may drift from the undecomposed flow; use fewer sub-meshes.",
                              width)}});
    }
}

}  // namespace seamflow
