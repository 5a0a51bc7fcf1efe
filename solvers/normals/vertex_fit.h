#pragma once

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"

namespace seamflow {

/// Normals that faces are to get.
struct NoisyNormals {
    /// #F by 3: of length 1, to either side; or 0 for faces that any normal suits.
    const Points& normals;
    /// Of the normals, before they became these: a chord.
    double noise;
};

/// Moves vertices so that faces get the normals wanted (Sun et al., Fast and effective feature-preserving mesh
/// denoising, 2007): again and again each vertex goes to where the mean of n_f ⟨n_f, c_f - v⟩ over its faces takes it,
/// with c_f the centroid of the face, all at once. At first it also goes towards the mean of its neighbours, in those
/// directions alone in which its faces leave it free, and by a part that is the noise, a tenth at most: faces that
/// noise has folded over unfold so. Vertices on a boundary do not do that, so that a free boundary does not draw in.
/// Vertices that the topology holds stay, and those on feature lines stay on these. Bits do not depend on how loops are
/// run.
/// @param topology twins are not looked at.
/// @param lines of the mesh. @param vertices #V by 3: where they are, and then where they go.
void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                  const NoisyNormals& wanted, Points& vertices, const Executor& exec = run_serially);

}  // namespace seamflow
