#pragma once

#include <array>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/position_filters.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// Several estimates of the true normal of each face. Each is a vector along a normal. A mean of unit normals is the
/// shorter, the less they agree.
struct NormalEstimates {
    std::vector<FaceVectors> vectors;
    /// The indices of the estimates that the others are compared with.
    std::array<int, 3> anchors{};
};

/// The filters that make the estimates.
class NormalEstimator {
  public:
    /// @param mesh its vertices are not used. @param topology with twins, which are not needed later. Both must outlive
    /// the estimator.
    NormalEstimator(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

    /// Begins with a noisy surface. @param positions #V by 3.
    void begin(const Points& positions, const Executor& exec = run_serially);

    /// Makes estimates from the noisy surface alone: means over one to eight rounds, bilateral means of two widths,
    /// normals of surfaces whose vertices were filtered, means of patches on one side of edges.
    /// @param found replaced; its memory is reused, as in `further`.
    void first(NormalEstimates& found, const Executor& exec = run_serially);

    /// Makes estimates with the help of an earlier result: means of the noisy normals over faces that belong together
    /// according to this result, further means of the result, and normals of filtered surfaces as in `first`. Weights
    /// and areas come from the positions of the last `refine`.
    /// @param normals of length 1, or 0 where neither the face nor the faces around it have an area.
    void further(const FaceVectors& normals, NormalEstimates& found, const Executor& exec = run_serially);

    /// Computes areas and centroids at these positions, #V by 3.
    void refine(const Points& positions, const Executor& exec = run_serially) { averages_.measure(positions, exec); }

    [[nodiscard]] const FaceAverages& averages() const { return averages_; }
    [[nodiscard]] const VertexAverages& vertex_averages() const { return of_vertices_; }

    // Not copied, because filters refer to averages_.
    NormalEstimator(const NormalEstimator&) = delete;
    NormalEstimator& operator=(const NormalEstimator&) = delete;

  private:
    /// Averages vectors over more and more rounds, with the current weights.
    /// @param on_round called with the number of each round and its result.
    template <class OnRound>
    void take_means(const FaceVectors& vectors, int rounds, const Executor& exec, OnRound&& on_round);

    FaceAverages averages_;
    VertexAverages of_vertices_;
    PositionFilters filters_;
    VertexNormals vertex_normals_;
    /// The unit normals of the noisy surface.
    FaceVectors noisy_;
    /// The normals of filtered surfaces: for `first`, which swaps them into its result; for `further`; and those of
    /// robust filters, for both.
    std::vector<FaceVectors> of_positions_;
    std::vector<FaceVectors> of_positions_further_;
    std::vector<FaceVectors> of_robust_positions_;
    /// Scratch, reused in each round.
    AverageWeights weights_;
    std::array<FaceVectors, 2> scratch_;
};

}  // namespace seamflow
