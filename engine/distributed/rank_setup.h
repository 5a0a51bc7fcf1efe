#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/conversation.h"
#include "engine/distributed/mesh_part.h"
#include "engine/distributed/rank_exchange.h"
#include "engine/measure/surface_measures.h"
#include "engine/options/flow_options.h"
#include "engine/steppers/schur_stepper.h"
#include "engine/steppers/sweep_stepper.h"
#include "partition/topology.h"

namespace seamflow {

/// A sub-mesh and the rank that has it.
struct OwnedSubMesh {
    Index number = 0;
    std::int32_t rank = 0;
};

/// All sub-meshes of all ranks, in ascending order of their numbers.
/// @throws InputError for one that several ranks have.
std::vector<OwnedSubMesh> gather_sub_meshes(Conversation& talk, const MeshPart& part);

/// The box around the vertices of the faces of all ranks.
BoundingBox gather_box(Conversation& talk, const PolygonMesh& mesh);

/// What a rank knows of a mesh before the flow begins.
struct RankMesh {
    /// Its own faces and two layers around them, near the origin, with local labels.
    MeshPart part;
    Topology topology;
    /// By local label.
    std::vector<KnownSubMesh> known;
    std::vector<std::uint8_t> is_own;
};

/// Grows the part of a rank by what it has to know of others, and settles which vertices move.
/// @param offset to be subtracted from all positions.
/// @throws InputError for sub-meshes and faces that cannot be used.
RankMesh make_rank_mesh(Conversation& talk, const MeshPart& own, const std::vector<OwnedSubMesh>& all,
                        const Point& offset, const FlowOptions& options);

/// Decomposes what a rank knows.
/// @param mesh receives how many vertices each sub-mesh has.
Decomposition decompose_rank_mesh(RankMesh& mesh);

/// Agrees with the other ranks on the order of the sweep.
/// @param all see gather_sub_meshes. @param foreign is put into the result.
/// @param rank_of_all receives the place of each of them in the sweep.
RankSubMeshes make_rank_sub_meshes(Conversation& talk, const RankMesh& mesh, Decomposition decomposition,
                                   const std::vector<OwnedSubMesh>& all, const FlowOptions& options,
                                   ForeignSubMeshes& foreign, std::vector<Index>& rank_of_all);

/// What converged steps need, which ranks take together.
/// @param talk must outlive the result. @param all see gather_sub_meshes.
PeerSubMeshes make_peer_sub_meshes(Conversation& talk, const RankMesh& mesh, Decomposition decomposition,
                                   const std::vector<OwnedSubMesh>& all);

}  // namespace seamflow
