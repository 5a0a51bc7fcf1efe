#pragma once

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"

namespace seamflow {

/// The wanted normals of faces, which the faces are to get: smoothed normals of a noisy surface.
struct NoisyNormals {
    /// #F by 3: of length 1, to either side; 0 for faces without a wanted normal.
    const Points& normals;
    /// The noise of the normals before smoothing: a chord.
    double noise;
    /// The number of rounds with relaxation along the surface, and of rounds without relaxation after them.
    int relaxing_rounds = 10;
    int plain_rounds = 20;
};

/// Moves vertices so that faces get the wanted normals (Sun et al., Fast and effective feature-preserving mesh
/// denoising, 2007): in each round, all vertices at once move by the mean of n_f ⟨n_f, c_f - v⟩ over their faces, with
/// c_f the centroid of the face. In the first rounds, a vertex also moves towards the mean of its neighbours, only in
/// directions in which its faces leave it free, by a fraction equal to the noise, at most a tenth: this unfolds faces
/// that noise has folded over. A face whose centroid is several times further away than the nearest one at a vertex
/// counts less there: fans of slivers would throw the vertex far. Vertices on a boundary do not relax, so that a free
/// boundary does not shrink. Vertices fixed by the topology do not move, and vertices on feature lines stay on their
/// lines. Bits do not depend on how loops are run.
/// @param topology twins are not used.
/// @param lines of the mesh. @param vertices #V by 3: positions, replaced by the new ones.
void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                  const NoisyNormals& wanted, Points& vertices, const Executor& exec = run_serially);

}  // namespace seamflow
