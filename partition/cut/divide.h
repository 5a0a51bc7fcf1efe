#pragma once

#include <span>
#include <vector>

#include "partition/cut/face_graph.h"

namespace seamflow {

/// The treatment of the parts of a graph after METIS has divided it.
enum class Afterwards {
    /// Nothing: METIS must shape the parts well.
    Nothing,
    /// Parts are made connected, balanced and refined (see refine): METIS may be quick.
    Refined,
};

/// Divides the nodes of a graph into parts with short boundaries (METIS). The same input gives the same parts each
/// time. May be called from several threads, which then wait for each other.
/// @param shares one entry per part, at least 1: part weights are about proportional to these.
/// @returns one label per node, from 0 to the number of parts - 1; on graphs of few nodes per part some labels may not
/// occur, and a part need not be connected.
/// @throws ComputationError if METIS fails.
std::vector<Index> metis_k_way(const FaceGraph& graph, std::span<const Index> shares,
                               Afterwards afterwards = Afterwards::Nothing);

/// Divides the nodes of a graph into k parts of about equal weight with short boundaries, in stages: into a few groups
/// of parts, then each of these. METIS takes several times as long for many parts at once. The same graph and k give
/// the same parts each time.
/// @returns one label per node; every part lies within one component, so that there are at least as many as
///          components. As with metis_k_way labels may be missing, and parts need not be connected.
/// @throws ComputationError if METIS fails.
std::vector<Index> divide(const FaceGraph& graph, const Components& components, Index k,
                          Afterwards afterwards = Afterwards::Nothing);

}  // namespace seamflow
