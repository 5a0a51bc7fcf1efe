#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The length, without sign, of the motion of vertex v along the mean normal of its faces; 0 where there is no normal.
/// @param topology needs no twins. @param normals #F by 3: of length 1 or 0, to either side.
double motion_along_normal(const Topology& topology, const Points& normals, Index v, const Point& motion);

/// #V: the mean length of the edges at each vertex; 0 without faces.
/// @param topology needs no twins.
std::vector<double> edge_lengths_at_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                             const Executor& exec = run_serially);

/// Reduces motions to their components along the wanted normals of the faces at each vertex, so that vertices hardly
/// slide along the surface and a parametrisation stays: on smooth surfaces along the one normal, at edges and corners
/// in all directions that change a face. Around faces that this would fold, vertices keep their whole motion. Bits do
/// not depend on how loops are run.
/// @param topology needs no twins.
/// @param before, after #V by 3. @param wanted #F by 3: the wanted normals of faces; 0: none.
/// @returns #V by 3.
Points along_normals(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                     const Points& wanted, const Executor& exec = run_serially);

/// Halves, repeatedly, the motion of the vertices of faces that have turned away from their wanted normals, or nearly
/// so, and were nearer to them before, and of faces that have turned over against their neighbours (see folded_faces),
/// until there are none.
/// @param topology needs no twins.
/// @param before #V by 3. @param wanted #F by 3: the wanted normals of faces; 0: none.
/// @param positions #V by 3; replaced.
void keep_facing(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& wanted,
                 Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
