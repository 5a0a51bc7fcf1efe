#pragma once

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"

namespace seamflow {

/// Target normals of faces.
struct NoisyNormals {
    /// #F by 3: of length 1, to either side; or 0 for unconstrained faces.
    const Points& normals;
    /// Of the normals before smoothing: a chord.
    double noise;
    /// How often vertices move with relaxation along the surface, and then without.
    int relaxing_rounds = 10;
    int plain_rounds = 20;
};

/// Moves vertices so that faces get the wanted normals (Sun et al., Fast and effective feature-preserving mesh
/// denoising, 2007): repeatedly, and all at once, each vertex moves by the mean of n_f ⟨n_f, c_f - v⟩ over its faces,
/// with c_f the centroid of the face. At first it also moves towards the mean of its neighbours, only in directions in
/// which its faces leave it free, by a fraction equal to the noise, at most a tenth: this unfolds faces that noise has
/// folded over. Faces that reach several times further than the nearest one at a vertex count less there: fans of
/// slivers would throw it far. Vertices on a boundary do not relax, so that a free boundary does not shrink. Vertices
/// fixed by the topology stay, and those on feature lines stay on them. Bits do not depend on how loops are run.
/// @param topology twins are not used.
/// @param lines of the mesh. @param vertices #V by 3: positions, replaced by the new ones.
void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                  const NoisyNormals& wanted, Points& vertices, const Executor& exec = run_serially);

}  // namespace seamflow
