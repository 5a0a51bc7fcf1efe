#pragma once

#include <vector>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Whether faces at v have different labels.
bool is_mixed(const Topology& topology, const std::vector<Index>& labels, Index v);

/// The vertices whose faces have different labels, ascending.
std::vector<Index> mixed_vertices(const Topology& topology, const std::vector<Index>& labels,
                                  const Loop& loop = run_serially);

/// Straightens the seams between parts, which follow the edges of clusters: in each round every face takes the label
/// that weighs most around it, a face counting once for every vertex of kind Interior that the two share. Since the
/// number of shared vertices is a positive semi-definite kernel, all faces may change at once and the sum over these
/// vertices of pairs of faces with different labels still falls (Esedoḡlu and Otto 2015, Threshold dynamics for
/// networks with arbitrary surface tensions). Parts may come out pinched or in pieces (see repair).
/// @param labels #F, at least 0; none is carried into another connected component.
void straighten_seams(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, int rounds,
                      const Loop& loop = run_serially);

}  // namespace seamflow
