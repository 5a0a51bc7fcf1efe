#pragma once

#include <vector>

#include "engine/denoise/whole_mesh_stepper.h"
#include "engine/options/motion_options.h"
#include "engine/tasks/progress.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/rim_curves.h"

namespace seamflow {

/// Takes steps in which only the boundary of a surface moves (see SmoothRims), and a band beside it: boundary
/// vertices move to a smooth curve, at right angles to the curve and along the surface; the surface follows within the
/// band.
class RimStepper final : public WholeMeshStepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper; the twins of the topology are not needed later.
    /// @param time_step dt of one of `steps` steps, in length².
    RimStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion, double time_step,
               int steps, Progress& progress);

    /// @throws ComputationError if the result is not finite.
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) override { positions_ = image; }
    void save(StepMemory& memory) const override { memory.positions = positions_; }
    void restore(const StepMemory& memory) override { positions_ = memory.positions; }
    void report_to(DenoiseReport& report) const override;

  private:
    const PolygonMesh* mesh_;
    const Topology* topology_;
    std::vector<RimCurve> curves_;
    VertexNormals vertex_normals_;
    /// The radius of bumps that a step halves, in units of length.
    double radius_;
    /// #V: the fraction of its displacement that each vertex moves by; empty: 1.
    std::vector<double> strengths_;
    Points positions_;
    LoopCount loops_;
};

}  // namespace seamflow
