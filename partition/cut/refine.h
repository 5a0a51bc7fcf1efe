#pragma once

#include <vector>

#include "partition/cut/face_graph.h"

namespace seamflow {

/// How much heavier than the mean of all parts a part may become when nodes or faces move between parts.
inline constexpr double balance_tolerance = 0.04;

/// Makes the parts of a divided graph connected: each keeps its heaviest connected component (of equals the first), and
/// every other one goes to the neighbouring part to which its arcs weigh most.
/// @param labels #nodes, from 0 to n_labels - 1; no part may have nodes in several connected components of the graph.
/// @returns whether a part had several.
bool join_loose_components(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels);

/// Makes the parts of a divided graph connected (see join_loose_components) and better: nodes move to neighbouring
/// parts where one of the two is too heavy or too light (see balance_tolerance), to the part across their heaviest
/// arcs, and elsewhere where this cuts less.
/// @param labels #nodes, from 0 to n_labels - 1; no part may have nodes in several connected components of the graph.
void refine(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
