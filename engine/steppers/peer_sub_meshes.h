#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/tasks/run_for_sub_mesh.h"
#include "partition/decomposition/decomposition.h"
#include "solvers/interface/interface_peers.h"

namespace seamflow {

/// The sub-meshes of one of several peers.
struct PeerSubMeshes {
    /// Its own sub-meshes in full, and the known part of those around them (see decompose_part).
    Decomposition decomposition;
    std::unique_ptr<InterfacePeers> peers;
    /// #sub-meshes.
    std::vector<SubMeshName> names;
};

/// Those of a single peer.
inline PeerSubMeshes alone(Decomposition decomposition)
{
    std::vector<SubMeshName> names;
    for (const SubMesh& sub_mesh : decomposition.sub_meshes)
        names.push_back({static_cast<Index>(names.size()), sub_mesh.n_vertices, sub_mesh.faces.front()});
    auto peers = std::make_unique<OnePeer>(static_cast<Index>(names.size()));
    return {std::move(decomposition), std::move(peers), std::move(names)};
}

}  // namespace seamflow
