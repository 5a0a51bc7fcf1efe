#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/rank_exchange.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/measure/bounding_box.h"
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

/// The box around the vertices of the faces of all ranks.
BoundingBox gather_box(Communicator& comm, const PolygonMesh& mesh);

/// What a rank knows of a mesh before the flow begins.
struct RankMesh {
    /// All sub-meshes of all ranks, in ascending order of their numbers.
    std::vector<OwnedSubMesh> all;
    /// Its own faces and two layers around them, near the origin, with local labels. Faces that repeat others are left
    /// out.
    MeshPart part;
    Topology topology;
    /// By local label.
    std::vector<KnownSubMesh> known;
    std::vector<std::uint8_t> is_own;
    /// Of all ranks: faces that were left out, vertices held because they are not manifold, and those at junctions that
    /// move.
    std::int64_t n_repeated = 0;
    std::int64_t n_non_manifold = 0;
    std::int64_t n_junctions = 0;
    /// Of all ranks: all faces, and their vertices.
    std::int64_t n_faces = 0;
    std::int64_t n_vertices = 0;
    /// A sentence on faces and vertices that were left out or held.
    std::vector<std::string> remarks;

    /// Whether a known vertex has faces of this rank.
    [[nodiscard]] bool has_own_faces(Index v) const;
};

/// Which sub-meshes a flow can use.
enum class SoundCut {
    /// Connected, with one fan of faces at each vertex, as one process has them.
    Required,
    /// Any, as converged steps need no more of Γ than its vertices.
    NotNeeded
};

/// Grows the part of a rank by what it must know of others, and decides which vertices move.
/// @param offset to be subtracted from all positions.
/// @throws InputError for sub-meshes and faces that cannot be used.
RankMesh make_rank_mesh(Communicator& comm, const MeshPart& own, const Point& offset, const FlowOptions& options,
                        SoundCut sound = SoundCut::Required);

/// Decomposes what a rank knows.
/// @param mesh receives how many vertices each sub-mesh has.
Decomposition decompose_rank_mesh(RankMesh& mesh);

/// Agrees with the other ranks on the order of the sweep.
/// @param comm, mesh must outlive the result. @param foreign is put into it.
RankSubMeshes make_rank_sub_meshes(Communicator& comm, const RankMesh& mesh, Decomposition decomposition,
                                   const FlowOptions& options, ForeignSubMeshes& foreign);

/// The ranks as peers that work on all sub-meshes together.
/// @param comm must outlive the result.
std::unique_ptr<InterfacePeers> make_rank_peers(Communicator& comm, const RankMesh& mesh);

/// What ranks need to take converged steps together.
/// @param comm must outlive the result.
PeerSubMeshes make_peer_sub_meshes(Communicator& comm, const RankMesh& mesh, Decomposition decomposition);

}  // namespace seamflow
