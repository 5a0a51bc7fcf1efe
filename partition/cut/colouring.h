#pragma once

#include <span>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The neighbours of each node, ascending. Of two neighbours, each is in the list of the other.
using Adjacency = std::vector<std::vector<Index>>;

/// Colours the nodes so that neighbours differ: connected components with two colours where possible, the others with
/// few (nodes whose neighbours have most colours first). Deterministic.
/// @returns one colour per node, from 0.
std::vector<Index> colour(const Adjacency& adjacency);

/// The number of colours used: one more than the highest.
Index n_colours(std::span<const Index> colours);

}  // namespace seamflow
