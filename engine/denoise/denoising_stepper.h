#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/denoise/denoise_options.h"
#include "engine/denoise/whole_mesh_stepper.h"
#include "engine/options/motion_options.h"
#include "engine/tasks/progress.h"
#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/mesh_denoiser.h"
#include "solvers/rounding/rounded_surface.h"

namespace seamflow {

/// Takes steps that remove noise (see RemoveNoise and MeshDenoiser), or, where coordinates are rounded, finds the
/// smoothest surface within the bounds in the first step (see smooth_rounded). Vertices on feature edges do not move,
/// and where noise is removed, faces on the two sides of feature edges do not affect each other.
class DenoisingStepper final : public WholeMeshStepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper, and so must the twins of the topology.
    DenoisingStepper(const PolygonMesh& mesh, const Topology& topology, const MotionOptions& motion,
                     const RemoveNoise& method, Progress& progress);

    /// @throws ComputationError if the result is not finite.
    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) override { positions_ = image; }
    [[nodiscard]] std::span<const std::uint8_t> bounded() const override { return is_rounded_; }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void report_to(DenoiseReport& report) const override;

  private:
    /// The mesh cut open along feature edges: with one copy of a vertex for each side of the feature edges there. The
    /// first copy has the number of the vertex. Copies do not move where there are several.
    struct CutOpen {
        PolygonMesh mesh;
        Topology topology;
        /// #V of `mesh`: the vertex of the mesh that each is a copy of.
        std::vector<Index> vertex_of;
    };

    /// Cuts a mesh open along feature edges. @returns null without feature edges.
    static std::unique_ptr<const CutOpen> cut_open(const PolygonMesh& mesh, const Topology& topology,
                                                   const std::vector<Edge>& feature_edges, const Executor& exec);

    /// How vertices may move within the rounding of their coordinates.
    [[nodiscard]] RoundedMotion rounded_motion() const;

    /// #V of the mesh on which noise is removed: the positions of the copies of vertices.
    [[nodiscard]] Points of_copies(const Points& positions) const;

    /// In the first step: smooths within the bounds of rounded coordinates. @returns whether it did. It does nothing in
    /// later steps, if no coordinates are rounded, and if rounding explains the roughness of no component.
    bool smooth_within_rounding(const Points& before, const Executor& exec);

    /// Removes noise of components whose roughness rounding does not explain, beside those where it does.
    /// @param faces those of these components, ascending. @param held #V: 1 at vertices that stay; empty: there are
    /// none.
    void remove_noise_of(const std::vector<Index>& faces, const std::vector<std::uint8_t>& held, const Points& before,
                         const Executor& exec);

    void remove_noise(const Points& before, const Executor& exec);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    Rounding rounding_;
    double edge_angle_;
    MotionDirection direction_;
    /// Whether copies of vertices may count as one.
    bool joins_copies_;
    /// The largest distance from the initial positions, in units of length.
    std::optional<MotionBound> within_;
    /// Ascending.
    std::vector<Index> on_feature_edges_;
    /// The mesh on which noise is removed; null without feature edges: then it is mesh_.
    std::unique_ptr<const CutOpen> open_;
    /// One per vertex of the mesh on which noise is removed: the fraction of its displacement by which the vertex
    /// moves. Empty: 1 everywhere.
    std::vector<double> strengths_;
    MeshDenoiser denoiser_;
    Points positions_;
    LoopCount loops_;
    /// The noise that the first step found; nothing before this step. If some components are rounded: the noise of the
    /// others.
    std::optional<SurfaceNoise> noise_;
    /// The rounding that the first step smoothed; nothing if no component is rounded.
    std::optional<RoundingReport> rounded_;
    /// #F: 1 in components that the first step smoothed within the bounds of rounding; empty: there are none.
    std::vector<std::uint8_t> is_rounded_;
    /// The spikes that stayed in the first step.
    std::vector<Spike> spikes_;
};

}  // namespace seamflow
