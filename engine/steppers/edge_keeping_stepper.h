#pragma once

#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"
#include "solvers/normals/normal_diffusion.h"

namespace seamflow {

/// Takes steps that keep edges (FlowOptions::keep_edges): face normals diffuse by dt, but not across edges, and the
/// vertices move to fit them. The whole mesh at once, its faces and vertices shared among the threads; the bits do not
/// depend on their number.
class EdgeKeepingStepper final : public Stepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper; the twins of the topology are not needed later.
    EdgeKeepingStepper(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options,
                       Progress& progress);

    /// @throws ComputationError if the result is not finite.
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) override { positions_ = image; }
    void set_vertices(std::span<const Index> vertices, const Points& to) override
    {
        move_rows(vertices, to, positions_);
    }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    /// The stepper has no tasks.
    void add_seconds(PhaseSeconds&) const override {}
    /// A single step has no data for the report.
    void report_to(StepReport&) const override {}
    void report_to(FlowReport& report) const override;

  private:
    const PolygonMesh* mesh_;
    const Topology* topology_;
    double time_step_;
    double angle_;
    /// #V: the fraction of its displacement that each vertex moves by; empty: 1.
    std::vector<double> step_scales_;
    FeatureLines lines_;
    NormalDiffusion diffusion_;
    Points positions_;
    /// The largest displacement of a vertex in a step, in mean edge lengths.
    double furthest_ = 0.0;
    LoopCount loops_;
};

}  // namespace seamflow
