#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"

namespace seamflow {

/// Takes back how far a surface has drifted from its rounded positions. Rounding leads as often to one side of a
/// surface as to the other, so that neighbours that have all moved to the same side, as on crests, in valleys and on
/// thin vessels, have moved too far: they go back along their normals by the mean of their motions, as far as boxes
/// allow. Means that are as small as chance makes them do not count.
/// @param neighbours #V: the vertices that share an edge with each. @param topology vertices at junctions stay.
/// @param rounds of averages over neighbours. @param by_chance the largest mean that chance explains, in units of
/// length. @param positions #V by 3: in the boxes; replaced.
/// @returns the vertices that have gone back, ascending.
std::vector<Index> take_back_drift(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                                   const Boxes& boxes, int rounds, double by_chance, Points& positions,
                                   const Executor& exec = run_serially);

}  // namespace seamflow
