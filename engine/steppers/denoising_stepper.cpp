#include "engine/steppers/denoising_stepper.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "partition/errors.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/spikes.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// The most relaxation of vertices along the surface, as for edges that are kept.
constexpr double most_relaxation = 0.1;
/// A part of the surface this small that has none is not worth a sentence.
constexpr double small_part = 0.05;

NoiseReport measure_noise(const PolygonMesh& mesh, const Noise& noise, const Executor& exec)
{
    using Sums = Eigen::Array2d;
    const Sums sums = sum(
        exec, mesh.n_faces(),
        [&](Index f) -> Sums {
            return std::ranges::any_of(mesh.face(f), [&](Index v) { return noise.parts[v] > 0.0; })
                       ? Sums(noise.of_faces[f] * noise.of_faces[f], 1.0)
                       : Sums(Sums::Zero());
        },
        Sums(Sums::Zero()));
    return {sums[1] > 0.0 ? std::sqrt(sums[0] / sums[1]) : 0.0, mesh.n_faces() > 0 ? sums[1] / mesh.n_faces() : 0.0};
}

/// The mean chord between faces and their wanted normals.
double mean_chord(const PolygonMesh& mesh, const Points& positions, const Points& wanted, const Executor& exec)
{
    const double total = sum(exec, mesh.n_faces(), [&](Index f) {
        const Point normal = vector_area(mesh.face(f), positions);
        const double length = normal.norm();
        return length > 0.0 ? (normal / length - wanted.row(f)).norm() : 0.0;
    });
    return total / std::max(mesh.n_faces(), Index{1});
}

}  // namespace

DenoisingStepper::DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options,
                                   Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , strengths_(options.motion.strength)
    , denoiser_(mesh, topology, progress.exec())
    , places_(mesh, topology, denoiser_.averages())
    , rims_(mesh, topology)
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
}

void DenoisingStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Executor exec = loops_.begin();
    spikes_ = find_spikes(*mesh_, *topology_, before, exec);
    positions_ = before;
    for (const Index v : spikes_)
        positions_.row(v) = before(neighbours_of(*mesh_, *topology_, v), Eigen::all).colwise().mean();
    positions_ = denoised(positions_, exec);
    for (const Index v : spikes_)
        positions_.row(v) = before.row(v);
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: scale the mesh to a size nearer to 1");
}

Points DenoisingStepper::denoised(const Points& before, const Executor& exec)
{
    const DenoisedNormals found = denoiser_.denoise(before, exec);
    Points fitted = before;
    fit_vertices(*mesh_, *topology_, {},
                 {found.normals, std::min(most_relaxation, mean_chord(*mesh_, before, found.normals, exec))}, fitted,
                 exec);
    const Noise noise = places_.find(*mesh_, *topology_, before, fitted, found, exec);
    if (!noise_)
        noise_ = measure_noise(*mesh_, noise, exec);
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        const double part = (strengths_.empty() ? 1.0 : strengths_[v]) * noise.parts[v];
        if (part < 1.0)
            fitted.row(v) = before.row(v) + part * (fitted.row(v) - before.row(v));
    });
    Points result = along_normals(*mesh_, *topology_, before, fitted, found.normals, exec);
    rims_.apply(*topology_, found.normals, noise.parts, result);
    keep_facing(*mesh_, *topology_, before, found.normals, result, exec);
    return result;
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

void DenoisingStepper::describe(FlowReport& report) const
{
    if (mesh_->n_faces() == 0)
        return;
    report.cut.sub_meshes = {{mesh_->n_faces(), mesh_->n_vertices()}};
    if (!noise_)
        return;
    report.noise = noise_;
    if (!spikes_.empty())
        report.remarks.push_back(fmt::format(
            "{} far from all neighbours, more than ten times the lengths of the edges there, and {}: remove {}, "
            "or give {} the right position.",
            spikes_.size() == 1 ? fmt::format("Vertex {} is", spikes_[0])
                                : fmt::format("{} vertices, the first of which is {}, are", spikes_.size(), spikes_[0]),
            spikes_.size() == 1 ? "stays" : "stay", spikes_.size() == 1 ? "it" : "them",
            spikes_.size() == 1 ? "it" : "them"));
    if (noise_->part == 0.0) {
        report.remarks.emplace_back("No noise was found: nothing is smoothed. Use --radius to smooth anyway.");
        return;
    }
    std::string where;
    if (noise_->part < 1.0 - small_part)
        where = fmt::format(" on {:.0f}% of the faces, none on the others", 100.0 * noise_->part);
    report.choices.push_back(fmt::format("noise of {:.2g} edge lengths{}: removed; edges and details that it does not "
                                         "explain were kept",
                                         noise_->deviation, where));
}

}  // namespace seamflow
