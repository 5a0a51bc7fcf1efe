#include "engine/setup/prepared_flow.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "engine/measure/remarks.h"
#include "engine/measure/surface_measures.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/moving_rim.h"
#include "engine/state/flow_identity.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "solvers/laplacian/delaunay_stiffness.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

namespace {

/// Checks the mesh, and computes the identity of the flow if that is needed.
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

/// Cuts the mesh.
/// @param choices gets a sentence if the number of sub-meshes is chosen.
Cut make_cut(const PolygonMesh& mesh, const MeshSize& size, const Topology& topology, const FlowOptions& options,
             const Executor& exec, const Alongside& alongside, std::vector<Remark>& choices)
{
    if (options.scheme == Scheme::ExplicitEuler || takes_whole_mesh(options.accuracy.approach))
        return cut_into(mesh, topology, 1, exec);
    if (!options.cut.labels.empty())
        return cut_by_labels(mesh, topology, options.cut.labels, exec);
    if (options.cut.subdomains > 0)
        return cut_into(mesh, topology, options.cut.subdomains, exec, alongside);
    const SubdomainChoice choice =
        choose_subdomains(size, options.time_step, needs_of(options.laplacian, options.accuracy.tolerance.has_value()));
    choices.push_back({"sub-meshes", {{"sub-meshes", choice.count}}, {choice.reason + "."}});
    return cut_into(mesh, topology, choice.count, exec, alongside);
}

/// Whether only the faces around a region need to flow: no option needs the whole surface, and no seam of a moving
/// boundary could open.
bool flows_alone(const FlowOptions& options)
{
    return !options.motion.strength.empty() && !options.motion.limits.exist() && !options.motion.strict &&
           !options.report.reference && !options.report.keep_gaps && options.motion.boundary == Boundary::Fixed;
}

/// Replaces faces by those of an intrinsic Delaunay triangulation, if the weights of the Laplacian are to be at least 0
/// and are not.
bool flip_edges(PreparedFlow& prepared, FlowingMesh& mesh, Surface& surface, const Executor& exec)
{
    const FlowOptions& options = prepared.options;
    if (options.weights == Weights::OfLaplacian)
        return false;
    std::optional<DelaunaySurface> flipped = make_delaunay(mesh.mesh(), surface.topology, options.laplacian,
                                                           options.weights == Weights::AtLeastZeroInFaces, exec);
    if (!flipped)
        return false;
    mesh.replace_faces(std::move(flipped->mesh), flipped->face_of);
    prepared.stiffness = std::move(flipped->stiffness);
    // Filters with factors outside 0 to 1 for some modes are excluded.
    surface.choices.push_back(
        {"flipped edges",
         {},
         {fmt::format("Edges opposite to obtuse angles are flipped within the surface, so that {}.",
                      filter_of(options).is_plain() ? "values stay in their range" : "no weight is below 0")}});
    return true;
}

/// Joins the faces and determines which vertices move.
void examine(PreparedFlow& prepared, FlowingMesh& mesh, Progress& progress)
{
    FlowOptions& options = prepared.options;
    prepared.surface = make_surface(
        mesh, options.motion,
        {.laplacian = options.laplacian,
         .keeps_all_faces = options.report.keep_gaps,
         .leaves_out_still_faces = flows_alone(options),
         .replace_faces = [&](FlowingMesh& flowing,
                              Surface& surface) { return flip_edges(prepared, flowing, surface, progress.exec()); }},
        progress);
    options.cut.labels = mesh.of_faces_left(options.cut.labels);
    prepared.choices = prepared.surface.choices;
    prepared.remarks = prepared.surface.remarks;
}

Remark choice_of(const ApproachChoice& choice)
{
    Remark::Numbers numbers;
    if (choice.tolerance)
        numbers.emplace_back("tolerance", *choice.tolerance);
    return {"approach", numbers, {choice.reason}};
}

/// METIS has one thread: other threads measure in the meantime. If METIS is not needed, measuring comes afterwards.
void cut_and_measure(PreparedFlow& prepared, const PolygonMesh& mesh, Progress& progress)
{
    bool is_measured = false;
    const auto measure = [&] {
        is_measured = true;
        const FlowOptions& options = prepared.options;
        // Sweeps order the colours by curvature.
        const bool is_ordering = options.accuracy.approach == Approach::Sweep;
        const bool is_beside_cut = options.report.measures && !takes_whole_mesh(options.accuracy.approach);
        if (is_ordering || is_beside_cut)
            prepared.curvature =
                measure_curvature(mesh, prepared.surface.topology, mesh.vertices, laplacian_of(options));
        if (options.report.measures)
            prepared.meter.emplace(mesh, prepared.surface.topology);
    };
    prepared.cut = make_cut(
        mesh, prepared.surface.size, prepared.surface.topology, prepared.options, progress.exec(),
        [&](const std::function<void()>& serial) { run_both(serial, measure); }, prepared.choices);
    if (!is_measured)
        measure();
}

}  // namespace

std::unique_ptr<PreparedFlow> prepare(FlowingMesh& mesh, FlowOptions given, bool is_observed,
                                      const FlowControl& control, Progress& progress)
{
    const FlowState* const resume = control.resume.get();
    auto prepared = std::make_unique<PreparedFlow>();
    prepared->options = std::move(given);
    const FlowOptions& options = prepared->options;
    prepared->identity = require_sound(mesh.mesh(), options, is_observed, resume, progress);
    prepared->need_of_junctions = need_of_junctions(options);
    if (!prepared->need_of_junctions.empty())
        prepared->options.motion.junctions = Junctions::Hold;
    examine(*prepared, mesh, progress);
    progress.count();
    const Topology& topology = prepared->surface.topology;
    AccuracyOptions& accuracy = prepared->options.accuracy;
    // A resumed flow continues in the way in which it began.
    if (options.resources.memory_limit && resume == nullptr && control.ranks == nullptr)
        prepared->without_factors = choose_without_factors(prepared->surface.size, options);
    if (prepared->without_factors) {
        prepared->choices_without_factors = {choice_of(*prepared->without_factors)};
        std::ranges::copy(prepared->choices, std::back_inserter(prepared->choices_without_factors));
    }
    const ApproachChoice choice = choose_approach(mesh.mesh(), topology, prepared->surface.size, prepared->options,
                                                  resume != nullptr ? std::optional(resume->approach) : std::nullopt,
                                                  control.ranks != nullptr ? Sharing::Ranks : Sharing::None);
    accuracy.approach = choice.approach;
    accuracy.tolerance = choice.tolerance;
    if (!choice.costs.empty())
        prepared->costs = choice.size;
    progress.count();
    cut_and_measure(*prepared, mesh.mesh(), progress);
    std::vector<Remark>& remarks = prepared->remarks;
    remarks.insert(remarks.begin(), prepared->cut.remarks.begin(), prepared->cut.remarks.end());
    // A single sub-mesh is solved exactly, whatever the approach.
    if (prepared->cut.n_parts == 1 && accuracy.approach == Approach::Converged && !choice.reason.empty()) {
        accuracy.approach = Approach::Undecomposed;
        accuracy.tolerance.reset();
    } else if (!choice.reason.empty()) {
        prepared->choices.insert(prepared->choices.begin(), choice_of(choice));
    }
    if (!accuracy.tolerance && options.scheme == Scheme::BackwardEuler)
        require_boundary_unshared(topology, prepared->cut.labels, moving_rim(mesh.mesh(), topology));
    return prepared;
}

void leave_factors(PreparedFlow& prepared, const PolygonMesh& mesh, const Executor& exec)
{
    prepared.options.accuracy.approach = prepared.without_factors->approach;
    prepared.options.accuracy.tolerance = prepared.without_factors->tolerance;
    prepared.cut = cut_into(mesh, prepared.surface.topology, 1, exec);
    prepared.choices = std::move(prepared.choices_without_factors);
    // No factors are to be made in later steps either.
    prepared.costs.reset();
}

void report_to(const PreparedFlow& prepared, const FlowingMesh& mesh, FlowReport& report)
{
    const FlowOptions& options = prepared.options;
    report.mesh = report_on(prepared.surface, mesh, options.motion.strength);
    report.time_step = options.time_step;
    report.convergence.approach = options.accuracy.approach;
    report.convergence.tolerance = options.accuracy.tolerance;
    report.cut.repaired_faces = prepared.cut.repaired_faces;
    report.choices = prepared.choices;
    report.remarks = prepared.remarks;
    if (report.mesh.non_manifold_vertices > 0)
        report.remarks.push_back(
            remark_on_non_manifold_vertices(report.mesh.non_manifold_vertices, prepared.need_of_junctions));
    if (report.mesh.junction_vertices > 0)
        report.remarks.push_back(remark_on_junctions(report.mesh.junction_vertices, options.laplacian));
    if (prepared.cut.n_parts > 1 && options.steps > 0 && !options.accuracy.tolerance) {
        const double width =
            width_in_diffusion_lengths(prepared.surface.size.area, prepared.cut.n_parts, options.time_step);
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
