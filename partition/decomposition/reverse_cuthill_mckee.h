#pragma once

#include <vector>

#include "partition/index.h"

namespace seamflow {

/// An order of the vertices of a graph in which adjacent vertices are near each other (reverse Cuthill-McKee, from a
/// vertex at the far end of each component).
/// @param adjacency for each vertex its neighbours, ascending.
std::vector<Index> reverse_cuthill_mckee(const std::vector<std::vector<Index>>& adjacency);

}  // namespace seamflow
