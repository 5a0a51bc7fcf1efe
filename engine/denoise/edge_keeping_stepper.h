#pragma once

#include <vector>

#include "engine/denoise/whole_mesh_stepper.h"
#include "engine/options/motion_options.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"
#include "solvers/normals/normal_diffusion.h"

namespace seamflow {

/// Takes steps that keep edges (see SmoothBetweenEdges).
class EdgeKeepingStepper final : public WholeMeshStepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper; the twins of the topology are not needed later.
    /// @param edge_angle in degrees. @param time_step dt, in length².
    EdgeKeepingStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion,
                       double edge_angle, double time_step, Progress& progress);

    /// @throws ComputationError if the result is not finite.
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) override { positions_ = image; }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void report_to(DenoiseReport& report) const override;

  private:
    const PolygonMesh* mesh_;
    const Topology* topology_;
    double time_step_;
    double angle_;
    /// #V: the fraction of its displacement that each vertex moves by; empty: 1.
    std::vector<double> strengths_;
    FeatureLines lines_;
    NormalDiffusion diffusion_;
    Points positions_;
    /// The largest displacement of a vertex in a step, in mean edge lengths.
    double furthest_ = 0.0;
    LoopCount loops_;
};

}  // namespace seamflow
