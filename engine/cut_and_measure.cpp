#include "engine/cut_and_measure.h"

#include <functional>

#include "engine/choose_subdomains.h"
#include "engine/parallel_loop.h"
#include "engine/surface_curvature.h"
#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

namespace {

const SubdomainNeeds& needs_of(const FlowOptions& options)
{
    if (is_symmetric(options.laplacian))
        return options.tolerance ? needs_of_converged_steps : needs_of_sweeps;
    return options.tolerance ? needs_of_krylov_steps : needs_of_unsymmetric_sweeps;
}

Cut make_cut(const PolygonMesh& mesh, const MeshSize& size, const Topology& topology, const FlowOptions& options,
             const Loop& loop, const Alongside& alongside)
{
    if (options.scheme == Scheme::ExplicitEuler)
        return cut_into(mesh, topology, 1, loop);
    if (!options.labels.empty())
        return cut_by_labels(mesh, topology, options.labels, loop);
    if (options.subdomains > 0)
        return cut_into(mesh, topology, options.subdomains, loop, alongside);
    const SubdomainChoice choice = choose_subdomains(size, options.time_step, needs_of(options));
    Cut cut = cut_into(mesh, topology, choice.count, loop, alongside);
    cut.remarks.insert(cut.remarks.begin(), choice.reason + ".");
    return cut;
}

}  // namespace

Cut cut_and_measure(const PolygonMesh& mesh, const MeshSize& size, const Topology& topology,
                    const ToleranceChoice& choice, FlowOptions& options, Measured& measured, const Progress& progress)
{
    const auto measure = [&] {
        measured.curvature = measure_curvature(mesh, topology, mesh.vertices, options.laplacian);
        measured.meter.emplace(mesh, topology);
    };
    Cut cut = make_cut(mesh, size, topology, options, progress.loop(),
                       [&](const std::function<void()>& serial) { run_both(serial, measure); });
    if (!measured.meter)
        measure();
    // A whole mesh is solved exactly either way.
    if (cut.n_parts == 1 && !choice.reason.empty())
        options.tolerance.reset();
    else if (!choice.reason.empty())
        cut.remarks.insert(cut.remarks.begin(), "Steps are converged: " + choice.reason + ".");
    return cut;
}

}  // namespace seamflow
