#pragma once

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"

namespace seamflow {

/// Moves vertices so that faces get the normals wanted (Sun et al., Fast and effective feature-preserving mesh
/// denoising, 2007): again and again each vertex goes to where the mean of n_f ⟨n_f, c_f - v⟩ over its faces takes it,
/// with c_f the centroid of the face, all at once. At first it also goes towards the mean of its neighbours, in those
/// directions alone in which its faces leave it free, and by a part that is the noise, a tenth at most: faces that
/// noise has folded over unfold so. Vertices on a boundary do not do that, so that a free boundary does not draw in.
/// Vertices that the topology holds stay, and those on feature lines stay on these. Bits do not depend on how loops are
/// run.
/// @param topology twins are not looked at.
/// @param normals #F by 3: of length 1, to either side; or 0 for faces that any normal suits.
/// @param noise of the normals, before they became those wanted: a chord.
/// @param lines of the mesh. @param from #V by 3, where vertices are. @param to #V by 3, of other memory: where they
/// go.
void fit_vertices(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines, const Points& normals,
                  double noise, const Points& from, Points& to, const Executor& exec = run_serially);

}  // namespace seamflow
