#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/tasks/run_for_sub_mesh.h"
#include "partition/decomposition/decomposition.h"
#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// The sub-meshes of one of several ranks.
struct RankSubMeshes {
    /// The rank's own sub-meshes in full, and the known part of the sub-meshes around them (see decompose_part).
    Decomposition decomposition;
    std::unique_ptr<InterfaceRanks> ranks;
    /// #sub-meshes: their names in messages.
    std::vector<SubMeshName> names;
};

/// The sub-meshes of a single rank.
inline RankSubMeshes alone(Decomposition decomposition)
{
    std::vector<SubMeshName> names = names_of(decomposition);
    auto ranks = std::make_unique<OneRank>(static_cast<Index>(names.size()));
    return {std::move(decomposition), std::move(ranks), std::move(names)};
}

}  // namespace seamflow
