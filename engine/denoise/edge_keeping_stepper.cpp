#include "engine/denoise/edge_keeping_stepper.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/normals/smoothed_between_edges.h"

namespace seamflow {

namespace {

/// The time step, in mean areas of the faces at a vertex, with which the vertex moves half of the way.
constexpr double short_step = 0.01;
/// In mean edge lengths: if all vertices move by less, the surface counts as unchanged.
constexpr double next_to_nothing = 0.01;

/// A diffusion of normals that does not cross the lines.
NormalDiffusion diffusion_between(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                                  const Executor& exec)
{
    if (lines.empty())
        return {mesh, topology, exec};
    const PolygonMesh open = lines.cut_open(mesh, topology);
    return {mesh, open, make_topology(open, exec), exec};
}

}  // namespace

EdgeKeepingStepper::EdgeKeepingStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion,
                                       double edge_angle, double time_step, Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , time_step_(time_step)
    , angle_(edge_angle)
    , step_scales_(motion.strength)
    , lines_(mesh, topology, motion.feature_edges)
    , diffusion_(diffusion_between(mesh, topology, lines_, progress.exec()))
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
}

void EdgeKeepingStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Executor exec = loops_.begin();
    const Points smoothed =
        smoothed_between_edges(*mesh_, *topology_, lines_, diffusion_, before, time_step_, angle_, exec);
    // Vertices are fitted completely, however short the step. For a short step they move by a fraction of that.
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        const auto corners = topology_->corners_at(v);
        double mean_area = 0.0;
        for (const Index corner : corners)
            mean_area += area(mesh_->face(topology_->face_of[corner]), before) / static_cast<double>(corners.size());
        const double step_scale = step_scales_.empty() ? 1.0 : step_scales_[v];
        const double fraction = step_scale * time_step_ / (time_step_ + short_step * mean_area);
        positions_.row(v) = fraction < 1.0
                                ? lines_.on_line(v, before.row(v) + fraction * (smoothed.row(v) - before.row(v)))
                                : Point(smoothed.row(v));
    });
    const double mean_edge = mean_edge_length(*mesh_, before, exec);
    if (mean_edge > 0.0)
        furthest_ = std::max(furthest_, (positions_ - before).rowwise().norm().maxCoeff() / mean_edge);
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: scale the mesh to a size nearer to 1");
}

void EdgeKeepingStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {furthest_};
}

void EdgeKeepingStepper::restore(const StepMemory& memory)
{
    positions_ = memory.positions;
    StepMemoryReader reader(memory);
    furthest_ = reader.number();
    reader.require_end();
}

void EdgeKeepingStepper::report_to(DenoiseReport& report) const
{
    if (mesh_->n_faces() == 0)
        return;
    if (furthest_ < next_to_nothing)
        report.remarks.push_back(
            {"all edges kept",
             {{"degrees", angle_}, {"mean edge lengths", furthest_}},
             {fmt::format("Nothing was smoothed: most faces lie in planes that meet in edges sharper than {:g}°, which "
                          "were kept (vertices moved by up to {:.1g} mean edge lengths in a step). If these are noise, "
                          "as in heights of whole numbers, give a larger angle, or leave out the amount, so that it "
                          "follows from the noise.",
                          angle_, furthest_)}});
    else
        report.remarks.push_back(
            {"edges kept",
             {{"degrees", angle_}, {"mean edge lengths", furthest_}},
             {fmt::format("Edges sharper than {:g}° were kept, and face normals smoothed between them, as much as was "
                          "asked for, whether there is noise or not: vertices moved by up to {:.2g} mean edge lengths "
                          "in a step.",
                          angle_, furthest_)}});
}

}  // namespace seamflow
