#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The vertices from which all edges are more than ten times as long as the longest edge around them, ascending. No
/// noise moves a vertex so far: such a spike is a wrong number, like the height that stands for missing data.
/// @param topology needs no twins. @param positions #V by 3.
std::vector<Index> find_spikes(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                               const Executor& exec = run_serially);

}  // namespace seamflow
