#pragma once

#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/topology.h"

/// The labels of faces: the number of the part of a cut to which each face belongs.
namespace seamflow {

/// Renumbers labels, all of them at least 0, to 0, 1, 2 … without gaps, keeping their order.
/// @returns the number of different labels.
Index compact_labels(std::vector<Index>& labels);

/// Lists the labels of the faces around vertex v, ascending, each once: replaces the content of `found`.
/// @param labels #F.
void labels_around(const Topology& topology, std::span<const Index> labels, Index v, std::vector<Index>& found);

/// Whether faces at v have different labels.
/// @param labels #F.
bool is_mixed(const Topology& topology, std::span<const Index> labels, Index v);

/// The vertices whose faces have different labels, ascending.
/// @param labels #F.
std::vector<Index> mixed_vertices(const Topology& topology, std::span<const Index> labels,
                                  const Executor& exec = run_serially);

}  // namespace seamflow
