#pragma once

#include <cstdint>
#include <vector>

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/face_neighbours.h"

namespace seamflow {

/// Smooths face normals by diffusion along the surface that stops at edges: (A + τ L) N ← A N, normalised, several
/// times. A has the face areas, and L is the Laplacian of the graph of faces that share a vertex, with the weights
///
///     w_ij = 4 √(a_i a_j / (m_i m_j)) γ_ij (1 - |n_i - n_j| |g_i - g_j| / (9σ²))², 0 where the bracket is negative
///
/// m_i = Σ_j γ_ij |c_i - c_j|², γ_ij = exp(-2 |c_i - c_j|² / (r_i r_j)), with c the centroids and r_i the root mean
/// square distance of the neighbours: where nothing stops them, normals diffuse as by the Laplacian of the surface, so
/// that τ is in length². The factor at the end, Tukey's diffusivity (Black et al., Robust anisotropic diffusion, 1998),
/// stops it at edges. It takes the geometric mean of two chords, between the normals n and between guides g, which
/// noise moves less (Zhang et al., Guided mesh normal filtering, 2015): g_i is the mean normal of the face and its
/// neighbours, in which neighbours that differ by more than noise count less. With much noise, g_i is the mean normal
/// of a patch, a face and its neighbours, around i or a neighbour of i: of the patch whose normals agree best, if they
/// agree as far as noise permits. σ is eight times the noise, and at most a third of the chord of the angle that counts
/// as an edge: sharper edges stop all diffusion, and without noise only planar faces have weights. The noise is
/// measured: the median chord between a face and the most similar one across an edge, or the mean of these. The system
/// is symmetric and positive definite; conjugate gradients solve for all three columns together, so that results rotate
/// with the surface. Bits do not depend on how loops are run.
class NormalDiffusion {
  public:
    /// @param mesh must outlive this; its vertices are not used. @param topology with twins; not needed afterwards.
    NormalDiffusion(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially)
        : NormalDiffusion(mesh, mesh, topology, exec)
    {
    }

    /// Normals diffuse between faces that share vertices of another mesh.
    /// @param connected the faces of `mesh` with other vertices; not needed afterwards. @param topology of `connected`.
    NormalDiffusion(const PolygonMesh& mesh, const PolygonMesh& connected, const Topology& topology,
                    const Executor& exec);

    /// Smooths the normals of the faces at some positions.
    /// @param positions #V by 3. @param time_step the sum of all τ, in length².
    /// @param angle between the normals of faces, in degrees, 0 to 180: sharper edges stay.
    /// @returns #F by 3, of length 1, or 0 for faces without area.
    [[nodiscard]] Points smoothed(const Points& positions, double time_step, double angle,
                                  const Executor& exec = run_serially);

    /// The noise of the last normals, before smoothing: a chord of unit normals. 0 on planar faces.
    [[nodiscard]] double noise() const { return noise_; }

  private:
    void measure(const Points& positions, double time_step, const Executor& exec);
    [[nodiscard]] double measure_noise(const Points& positions, const Points& normals, double edge_chord,
                                       const Executor& exec) const;
    void spread_over_planes(const Points& positions, const Points& normals, double edge_chord,
                            std::vector<double>& chords) const;
    void find_guides(const Points& normals, const Executor& exec);
    void find_patches(const Points& normals, const Executor& exec);
    void find_weights(const Points& normals, double longest, const Executor& exec);
    void diffuse(Points& normals, const Executor& exec);

    const PolygonMesh* mesh_;
    FaceNeighbours neighbours_;
    std::vector<std::int8_t> signs_;
    /// Per half-edge: the face across, or -1 if there is none.
    std::vector<Index> across_;
    /// #F: the areas, in mean face areas.
    std::vector<double> areas_;
    /// #F by 3: the centroids.
    Points centroids_;
    /// #F: r_i, in length, and 2 √(τ a_i / m_i), with the areas in mean face areas: the products of two of these are 4
    /// τ √(a_i a_j / (m_i m_j)).
    std::vector<double> reach_;
    std::vector<double> scale_;
    /// #F by 3: the guides; the mean normals of each face and its neighbours; and #F: their disagreement, 0 if all are
    /// equal, 1 if they cancel out.
    Points guides_;
    Points means_;
    std::vector<double> disagreement_;
    double noise_ = 0.0;
    /// τ w_ij for each entry of neighbours_, and their sum for each face.
    std::vector<float> weights_;
    std::vector<double> diagonal_;
    /// #F by 3: r, p and A p of the conjugate gradients.
    Points residual_;
    Points direction_;
    Points product_;
};

}  // namespace seamflow
