#include "engine/denoise/rim_stepper.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "engine/measure/smoothed_radius.h"
#include "partition/errors.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The radius R of one of n equal steps. A step leaves 1 / (1 + (R/r)⁴) of the height of bumps of radius r (see
/// smooth_curve); all steps together leave ½ where r is smoothed_radius.
double radius_of_step(double time_step, int steps)
{
    const int n = std::max(steps, 1);
    return smoothed_radius(time_step, n) * std::pow(std::exp2(1.0 / n) - 1.0, 0.25);
}

}  // namespace

RimStepper::RimStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion, double time_step,
                       int steps, Progress& progress)
    : mesh_(&mesh)
    , topology_(&topology)
    , curves_(find_rim_curves(mesh, topology))
    , vertex_normals_(mesh, topology)
    , radius_(radius_of_step(time_step, steps))
    , strengths_(motion.strength)
    , positions_(mesh.vertices)
    , loops_(1.0, progress)
{
}

void RimStepper::step(const Points& before)
{
    assert(&before != &positions_);
    const Executor exec = loops_.begin();
    Points normals(mesh_->n_faces(), 3);
    // Vector areas, whose lengths are the areas of faces. Faces without area get 0: a direction would be rounding.
    for_each(exec, mesh_->n_faces(), [&](Index f) {
        const std::span<const Index> face = mesh_->face(f);
        normals.row(f) = has_area(face, before) ? vector_area(face, before) : Point(Point::Zero());
    });
    Points motions = Points::Zero(before.rows(), 3);
    for (const RimCurve& curve : curves_) {
        const Points from = before(curve.vertices, Eigen::all);
        const Points smooth = smooth_curve(curve, from, radius_, /* keeps_corners= */ false).positions;
        const Points across = across_curve(curve, smooth, normals);
        for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            if (const Index v = curve.vertices[i]; topology_->moves(v))
                motions.row(v) = (smooth.row(row) - from.row(row)).dot(across.row(row)) * across.row(row);
        }
    }
    spread_into_band(*mesh_, *topology_, curves_, vertex_normals_, before, motions);
    keep_areas(*mesh_, before, normals, motions);
    positions_ = before;
    for_each(exec, mesh_->n_vertices(), [&](Index v) {
        if (!motions.row(v).isZero(0.0))
            positions_.row(v) += (strengths_.empty() ? 1.0 : strengths_[v]) * motions.row(v);
    });
    loops_.end();
    if (!positions_.allFinite())
        throw ComputationError("the result is not finite: scale the mesh to a size nearer to 1");
}

void RimStepper::report_to(DenoiseReport& report) const
{
    if (curves_.empty())
        report.remarks.push_back(
            {"no boundary", {}, {"The surface has no boundary: nothing moved. Leave <boundary> out to smooth it."}});
}

}  // namespace seamflow
