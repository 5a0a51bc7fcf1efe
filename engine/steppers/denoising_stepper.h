#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

/// Takes steps that remove noise (FlowOptions::denoise, see MeshDenoiser). The whole mesh at once, its faces and
/// vertices shared among the threads; the bits do not depend on their number. Vertices on feature edges do not move,
/// and faces on the two sides of feature edges do not affect each other.
class DenoisingStepper final : public Stepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper; the twins of the topology are not needed later.
    DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options, Progress& progress);

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
    /// The mesh cut open along feature edges: with one vertex for each side of the feature edges at a vertex.
    struct CutOpen {
        PolygonMesh mesh;
        Topology topology;
    };

    /// Null without feature edges.
    static std::unique_ptr<const CutOpen> cut_open(const PolygonMesh& mesh, const Topology& topology,
                                                   const std::vector<Edge>& feature_edges, const Executor& exec);

    const PolygonMesh* mesh_;
    std::unique_ptr<const CutOpen> open_;
    /// #V of the mesh that is cut open: the fraction of its displacement that each vertex moves by; empty: 1.
    std::vector<double> step_scales_;
    MeshDenoiser denoiser_;
    Points positions_;
    LoopCount loops_;
    /// The noise before the first step.
    std::optional<SurfaceNoise> noise_;
};

}  // namespace seamflow
