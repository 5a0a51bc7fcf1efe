#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/decomposition/grow.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Overlapping sub-meshes, any number of them, for the alternating Schwarz method (paper, eqs. 18 and 19). Each
/// sub-mesh is a part of the cut, grown into parts of the same or a later stage; the stage is the turn of a part in the
/// sweep, and parts that share a vertex of Γ have different stages. Its result is used only on the ungrown part; where
/// ungrown parts meet, on Γ, the result of the earliest stage is used.
namespace seamflow {

/// Cuts out the sub-mesh of the grown part s. Its interface is its artificial boundary: the vertices that may move and
/// have faces outside. Of the interface's lists only `vertices` is filled in (the others are -1 or empty): no fan is
/// needed there. Its corrected and owned vertices are vertices of the ungrown part. May be called for several
/// sub-meshes at once.
/// @param faces the faces of the ungrown part, in ascending order.
SubMesh make_overlapping_sub_mesh(const PolygonMesh& mesh, const Topology& topology, const Overlap& overlap, Index s,
                                  std::vector<Index> faces);

/// Joins sub-meshes made by make_overlapping_sub_mesh. `interface.sharing` lists the parts that have the vertex, the
/// halo transfers fill all vertices outside the ungrown part, and all parts between which there is a transfer are
/// adjacent.
Decomposition connect_overlapping(std::vector<SubMesh> sub_meshes, const Topology& topology, const Overlap& overlap);

}  // namespace seamflow
