#pragma once

#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/metrics/displacement.h"

namespace seamflow {

/// Sums over the steps so far (see TotalDisplacement): of the tangential parts, #V by 3, and of the lengths of both
/// parts, #V, NaN where they are not defined.
struct DisplacementSums {
    Points drift = Points(0, 3);
    std::vector<double> tangential;
    std::vector<double> normal;
};

/// Measures how the vertices of a flowing mesh move along the surface and out of it, step by step and in total. Runs in
/// parallel, sums in order: the bits do not depend on the number of threads.
class DisplacementMeter {
  public:
    /// @param mesh it and its topology must outlive the meter.
    DisplacementMeter(const PolygonMesh& mesh, const Topology& topology);

    /// Adds one step.
    /// @param before, after #V by 3; `before` is `after` of the last step, if there was one.
    DisplacementStatistics add_step(const Points& before, const Points& after);

    /// Of all steps so far.
    [[nodiscard]] TotalDisplacement total() const;

    /// The sums that the next step adds to, empty before the first; `restore` continues from them.
    /// @param now #V by 3, the positions then.
    /// @throws InputError if they do not fit.
    [[nodiscard]] DisplacementSums sums() const;
    void restore(const DisplacementSums& sums, const Points& now);

  private:
    void begin(const Points& positions);
    void measure_normals(const Points& positions);

    const PolygonMesh& mesh_;
    VertexNormals normals_;
    /// All empty before the first step. #V by 3: unit normals of the latest state, and the sums of the tangential
    /// parts.
    Points normal_;
    Points drift_;
    /// The sums of the lengths of both parts over those steps where they are defined.
    DisplacementField path_;
};

}  // namespace seamflow
