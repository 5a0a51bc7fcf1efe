#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/face_neighbours.h"

namespace seamflow {

/// #F by 4: one vector per face. The fourth number is 0, so that rows fill registers.
using FaceVectors = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;
using FaceVector = Eigen::Matrix<float, 1, 4>;

/// The weights of the neighbours of each face in an average.
struct AverageWeights {
    /// One weight per entry of FaceNeighbours::faces.
    std::vector<float> of_neighbours;
    /// #F: the inverse of the sum of the weights of the face itself and of its neighbours; 0 if all weights are 0.
    std::vector<float> inverse_sums;
};

/// Averages vectors over each face and the faces that share a vertex with it. The weight of face g at face f is
///
///     w_fg = (a_g / b_g) exp(-|c_f - c_g|² / (r_f r_g)) exp(-|n_f - n_g|² / 2σ²)
///
/// a is the area, b the mean area of a face and its neighbours, c the centroid, r the root mean square distance of the
/// neighbours' centroids, and n a guide normal, where one is given. Small faces count less than the others around them,
/// but where faces grow from row to row, such as the faces of a globe towards its equator, means are not drawn to the
/// larger faces, which would tilt them. With a guide this is the joint bilateral filter of normals (Zheng et al.,
/// Bilateral normal filtering for mesh denoising, 2011). Several rounds reach further. Bits do not depend on how loops
/// are run.
class FaceAverages {
  public:
    /// Prepares the neighbours. `measure` must be called before anything is averaged.
    /// @param mesh its vertices are not used. @param topology with twins, which are not needed later. Both must outlive
    /// the object. @param sheets over which faces averages reach.
    FaceAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially,
                 Sheets sheets = Sheets::All);

    /// Computes areas and centroids at these positions, #V by 3.
    void measure(const Points& positions, const Executor& exec = run_serially);

    /// The unit normals at these positions, on the same side of the surface where faces share an edge. A face without
    /// area gets the mean direction of its neighbours, with the weights without a guide; 0 if there is none.
    void measure_normals(const Points& positions, FaceVectors& normals, const Executor& exec = run_serially) const;

    /// 1 or -1 per face: the normals of faces with -1 are turned. Empty if no normal is turned.
    [[nodiscard]] const std::vector<std::int8_t>& signs() const { return signs_; }

    // The following functions write their results to their last arguments, whose memory is used again.

    /// Computes the weights without a guide.
    void weigh(AverageWeights& weights, const Executor& exec = run_serially) const;

    /// Computes the weights with a guide.
    /// @param guide of length 1 or 0. @param sigma σ: a chord of unit normals.
    void weigh(const FaceVectors& guide, float sigma, AverageWeights& weights,
               const Executor& exec = run_serially) const;

    /// The mean around each face. The mean of unit vectors is shorter than 1 if they differ.
    void average(const AverageWeights& weights, const FaceVectors& vectors, FaceVectors& means,
                 const Executor& exec = run_serially) const;

    /// The mean around each face, with the weights without a guide.
    void average(const FaceVectors& vectors, FaceVectors& means, const Executor& exec = run_serially) const;

    /// The bilateral mean, in which the vectors, of length 1 or 0, are their own guide.
    void average(float sigma, const FaceVectors& vectors, FaceVectors& means,
                 const Executor& exec = run_serially) const;

    /// Means over a wider neighbourhood, with weights that fall with distance: the solution X of (1 + t) X - t P X = N
    /// with t = 40, N being the vectors and P X the means around each face. Takes a fixed number of rounds of the
    /// Chebyshev iteration.
    void average_far(const AverageWeights& weights, const FaceVectors& vectors, FaceVectors& means,
                     std::array<FaceVectors, 2>& scratch, const Executor& exec = run_serially) const;

    /// The mean over the patch whose vectors agree best, among the patches around the face and around each of its
    /// neighbours; a patch is a face and its neighbours (Zhang et al., Guided mesh normal filtering, 2015).
    void average_best_patch(const FaceVectors& vectors, FaceVectors& means, const Executor& exec = run_serially) const;

    /// #F: the roughness of the surface around each face: the mean squared chord between its vector and those of its
    /// neighbours, each squared chord counting as at most `largest`. The mean has the weights without a guide.
    /// @param normals of length 1 or 0.
    [[nodiscard]] std::vector<float> roughness(const FaceVectors& normals, float largest,
                                               const Executor& exec = run_serially) const;

    [[nodiscard]] Index n_faces() const { return static_cast<Index>(areas_.size()); }

  private:
    const PolygonMesh* mesh_;
    const Topology* topology_;
    FaceNeighbours neighbours_;
    std::vector<std::int8_t> signs_;
    /// #F: the areas, in mean face areas.
    std::vector<float> areas_;
    /// One weight without a guide per entry of FaceNeighbours::faces.
    std::vector<float> near_;
};

/// Scales each vector to length 1; vectors of length 0 stay 0.
void normalise(FaceVectors& vectors, const Executor& exec = run_serially);

}  // namespace seamflow
