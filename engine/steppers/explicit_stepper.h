#pragma once

#include "engine/measure/flow_report.h"
#include "engine/setup/step_settings.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The square of the shortest edge that has an end that may move, in length²: the largest step that the paper (after
/// Desbrun et al. 1999) calls stable for explicit Euler. Edges of length zero are ignored; infinite if nothing moves.
/// On regular grids of quads or triangles the largest eigenvalue of Δ_F (Fujiwara) requires a quarter of it. Runs in
/// parallel.
double largest_explicit_step(const PolygonMesh& mesh, const Topology& topology, const Points& positions);

/// Takes explicit Euler steps V^{k+1} = (I - dt Δ(V^k)) V^k of the whole mesh, vertex by vertex in parallel. The bits
/// do not depend on the number of threads.
class ExplicitStepper final : public Stepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper.
    ExplicitStepper(const PolygonMesh& mesh, const Topology& topology, const StepEquation& equation,
                    Progress& progress);

    /// @throws OptionError naming largest_explicit_step if dt is above it in the first step; ComputationError if the
    ///         result is not finite.
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
    void require_stable(const Points& positions);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    Progress* progress_;
    ScaledLaplacian laplacian_;
    double time_step_;
    /// #V: s, which scales dt; empty: 1.
    std::vector<double> step_scales_;
    Points positions_;
    /// largest_explicit_step before the first step, and its smallest value so far.
    double first_limit_;
    double smallest_limit_;
};

}  // namespace seamflow
