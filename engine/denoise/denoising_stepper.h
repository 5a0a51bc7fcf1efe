#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/denoise/whole_mesh_stepper.h"
#include "engine/options/motion_options.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

/// Takes steps that remove noise (see RemoveNoise and MeshDenoiser). Vertices on feature edges do not move, and faces
/// on the two sides of feature edges do not affect each other.
class DenoisingStepper final : public WholeMeshStepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper; the twins of the topology are not needed later.
    /// @param edge_angle edges at which normals differ by more stay where the noise is small, in degrees.
    DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion, double edge_angle,
                     Progress& progress);

    /// @throws ComputationError if the result is not finite.
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) override { positions_ = image; }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void report_to(DenoiseReport& report) const override;

  private:
    /// The mesh cut open along feature edges: with one vertex for each side of the feature edges at a vertex.
    struct CutOpen {
        PolygonMesh mesh;
        Topology topology;
    };

    /// Cuts a mesh open along feature edges. @returns null without feature edges.
    static std::unique_ptr<const CutOpen> cut_open(const PolygonMesh& mesh, const Topology& topology,
                                                   const std::vector<Edge>& feature_edges, const Executor& exec);

    const PolygonMesh* mesh_;
    /// The mesh on which noise is removed; null without feature edges: then it is mesh_.
    std::unique_ptr<const CutOpen> open_;
    /// One per vertex of the mesh on which noise is removed: the fraction of its displacement by which the vertex
    /// moves. Empty: 1 everywhere.
    std::vector<double> strengths_;
    MeshDenoiser denoiser_;
    Points positions_;
    LoopCount loops_;
    /// The noise before the first step.
    std::optional<SurfaceNoise> noise_;
};

}  // namespace seamflow
