#pragma once

#include <vector>

#include "partition/cut/doubts.h"
#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes every part a manifold with boundary: connected through edges, and with one fan of faces around each of its
/// vertices (see first_defect). Moves faces between neighbouring parts, as few as it can; where that leads nowhere it
/// merges parts, and a part in several connected components of the mesh becomes one part in each. A cut without
/// defects is left as it is. Always succeeds; the same input gives the same result. About linear in the size of the
/// mesh.
/// @param labels #F, at least 0; on return from 0 to n_parts - 1 without gaps. The order of labels is kept; parts that
/// had to be divided get new labels after the largest.
/// @returns the number of faces that were given another label, renumbering apart.
Index repair(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels,
             const Loop& loop = run_serially);

/// The same for a cut of which each part is known to lie within one connected component of the mesh.
Index repair_within_components(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels,
                               const Loop& loop = run_serially);

/// The same for such a cut that is known to have no defects elsewhere than where there are doubts.
/// @param labels #F, from 0 to n_parts - 1 without gaps, as many as doubts.parts has entries.
Index repair_where_doubtful(const PolygonMesh& mesh, const Topology& topology, const Doubts& doubts,
                            std::vector<Index>& labels, const Loop& loop = run_serially);

}  // namespace seamflow
