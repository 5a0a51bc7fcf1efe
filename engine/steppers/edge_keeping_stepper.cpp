#include "engine/steppers/edge_keeping_stepper.h"

#include <cassert>

#include <fmt/format.h>

#include "partition/errors.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

EdgeKeepingStepper::EdgeKeepingStepper(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options,
                                       Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , time_step_(options.time_step)
    , angle_(options.keep_edges.value())
    , diffusion_(mesh, topology, progress.loop())
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
}

void EdgeKeepingStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Loop loop = loops_.begin();
    const Points normals = diffusion_.smoothed(before, time_step_, angle_, loop);
    fit_vertices(*mesh_, *topology_, normals, before, positions_, loop);
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: bring the mesh to a size nearer to 1");
}

void EdgeKeepingStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
}

void EdgeKeepingStepper::restore(const StepMemory& memory)
{
    positions_ = memory.positions;
    StepMemoryReader(memory).require_end();
}

void EdgeKeepingStepper::describe(FlowReport& report) const
{
    if (mesh_->n_faces() == 0)
        return;
    report.cut.sub_meshes = {{mesh_->n_faces(), mesh_->n_vertices()}};
    report.remarks.push_back(fmt::format("Edges sharper than {:g}° were kept: face normals were smoothed between them, "
                                         "and vertices moved to fit; no sub-meshes were needed, and no Laplacian.",
                                         angle_));
}

}  // namespace seamflow
