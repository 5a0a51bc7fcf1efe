#pragma once

#include "engine/flow_options.h"
#include "engine/flow_report.h"
#include "engine/flow_state.h"
#include "engine/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The square of the shortest edge that has an end that may move, in length²: the largest step that the paper (after
/// Desbrun et al. 1999) calls stable for explicit Euler. Edges without length do not count; infinite where nothing
/// moves. On regular grids of quads or triangles the largest eigenvalue of Δ_F asks for a quarter of it. Runs in
/// parallel.
double largest_explicit_step(const PolygonMesh& mesh, const Topology& topology, const Points& positions);

/// A mesh flowing as one, by explicit Euler steps V^{k+1} = (I - dt Δ(V^k)) V^k, vertex by vertex in parallel. The bits
/// do not depend on the number of threads.
class ExplicitFlow {
  public:
    /// @param mesh, topology, progress must outlive the flow.
    ExplicitFlow(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options, Progress& progress);

    /// One step. After an exception there are no positions, and the flow is at its end.
    /// @param before #V by 3: Vᵏ, what positions() were, in memory of its own.
    /// @throws OptionError naming largest_explicit_step if dt is above it in the first step; ComputationError if the
    ///         result is not finite.
    void step(const Points& before);

    /// #V by 3, after the last step.
    [[nodiscard]] const Points& positions() const { return positions_; }

    /// There are no pieces.
    [[nodiscard]] static const PolygonMesh* pieces() { return nullptr; }

    /// Gives what the next step needs, and takes it back, before any step: the flow then goes on from there.
    /// @throws InputError if it does not fit.
    void save(StepMemory& memory) const;
    void restore(const StepMemory& memory);

    /// There are no tasks.
    static void add_seconds(PhaseSeconds&) {}

    /// Of a single step it knows nothing to tell.
    static void describe(StepReport&) {}

    /// Fills in what the flow knows of itself: that it is one sub-mesh, and a remark where steps may not be stable.
    void describe(FlowReport& report) const;

  private:
    void require_stable(const Points& positions);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    Progress* progress_;
    Laplacian laplacian_;
    double time_step_;
    Points positions_;
    /// largest_explicit_step of the first step, and the smallest so far.
    double first_limit_;
    double smallest_limit_;
};

}  // namespace seamflow
