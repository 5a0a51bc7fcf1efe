#pragma once

#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/errors.h"
#include "partition/index.h"
#include "solvers/interface/interface_peers.h"
#include "solvers/platform/library_threads.h"

namespace seamflow {

/// By what a failure names a sub-mesh: its numbers in the whole mesh.
struct SubMeshName {
    Index number = 0;
    Index n_vertices = 0;
    /// One of its faces.
    Index face = 0;
};

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

/// Runs `body` for a sub-mesh, in one thread; failures name it.
template <class Body>
void run_for_sub_mesh(const SubMeshName& sub_mesh, Body&& body)
{
    const auto name = [&] {
        return "sub-mesh " + std::to_string(sub_mesh.number) + " (" + std::to_string(sub_mesh.n_vertices) +
               " vertices, among its faces number " + std::to_string(sub_mesh.face) + "): ";
    };
    const SingleThreadedOpenMp single_threaded;
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name() + error.what());
    } catch (const std::bad_alloc&) {
        throw ComputationError(name() + "out of memory: use more sub-meshes");
    }
}

}  // namespace seamflow
