#include "engine/steppers/denoising_stepper.h"

#include <cassert>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// A part of the surface this small that has none is not worth a sentence.
constexpr double small_part = 0.05;

}  // namespace

DenoisingStepper::DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options,
                                   Progress& progress)
    : mesh_(&mesh)
    , step_scales_(options.motion.strength)
    , denoiser_(mesh, topology, progress.exec(), options.keep_edges.value_or(MeshDenoiser::default_edge_angle))
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
}

void DenoisingStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Executor exec = loops_.begin();
    positions_ = denoiser_.denoise(before, step_scales_, exec);
    if (!noise_)
        noise_ = denoiser_.noise();
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: scale the mesh to a size nearer to 1");
}

void DenoisingStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
}

void DenoisingStepper::restore(const StepMemory& memory)
{
    positions_ = memory.positions;
    StepMemoryReader(memory).require_end();
}

void DenoisingStepper::report_to(FlowReport& report) const
{
    if (mesh_->n_faces() == 0)
        return;
    report.cut.sub_meshes = {{mesh_->n_faces(), mesh_->n_vertices()}};
    if (!noise_)
        return;
    report.noise = {noise_->edge > 0.0 ? noise_->deviation / noise_->edge : 0.0, noise_->part};
    if (!denoiser_.spikes().empty())
        report.remarks.push_back(remark_on_spikes(denoiser_.spikes()));
    if (noise_->part == 0.0) {
        report.remarks.emplace_back("No noise was found: nothing is smoothed. Use --radius to smooth anyway.");
        return;
    }
    std::string where;
    if (noise_->part < 1.0 - small_part)
        where = fmt::format(" on {:.0f}% of the vertices, none on the others", 100.0 * noise_->part);
    report.choices.push_back(fmt::format("noise of {:.2g} edge lengths{}: removed; edges and details that it does not "
                                         "explain were kept",
                                         report.noise->deviation, where));
}

}  // namespace seamflow
