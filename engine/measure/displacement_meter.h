#pragma once

#include <vector>

#include "engine/measure/run_report.h"
#include "partition/metrics/displacement.h"

namespace seamflow {

/// Sums over the steps so far (see TotalDisplacement): of tangential displacements, #V by 3; and of the lengths of
/// tangential and normal displacements, #V, NaN where they are not defined.
struct DisplacementSums {
    Points drift = Points(0, 3);
    std::vector<double> tangential;
    std::vector<double> normal;
};

/// Measures the tangential and the normal displacements of the vertices of a flowing mesh, step by step and in total.
/// Runs in parallel, sums in order: the bits do not depend on the number of threads.
class DisplacementMeter {
  public:
    /// @param mesh, topology must outlive the meter.
    DisplacementMeter(const PolygonMesh& mesh, const Topology& topology);

    /// Adds one step, and returns its displacements.
    /// @param before, after #V by 3; `before` is `after` of the last step, if there was one.
    DisplacementStatistics add_step(const Points& before, const Points& after);

    /// The total over all steps so far.
    [[nodiscard]] TotalDisplacement total() const;

    /// The sums to which the next step adds; empty before the first step.
    [[nodiscard]] DisplacementSums sums() const;
    /// Continues from sums of an earlier meter.
    /// @param now #V by 3, the positions at that time.
    /// @throws InputError if the sums do not fit the mesh.
    void restore(const DisplacementSums& sums, const Points& now);

  private:
    void begin(const Points& positions);
    void measure_normals(const Points& positions);

    const PolygonMesh& mesh_;
    VertexNormals normals_;
    /// #V by 3: unit normals of the latest state, and the sums of tangential displacements. Empty before the first
    /// step.
    Points normal_;
    Points drift_;
    /// The sums of the lengths of tangential and normal displacements, over the steps in which they are defined. Empty
    /// before the first step.
    DisplacementField path_;
};

}  // namespace seamflow
