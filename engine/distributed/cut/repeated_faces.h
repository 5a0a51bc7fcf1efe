#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/topology.h"

namespace seamflow {

/// A face that repeats another, both as numbered in the whole mesh.
struct Repetition {
    std::int64_t face;
    std::int64_t first;
};

/// Adds those of a part to `found`: only places where the mesh is not manifold are searched (see FlowingMesh).
/// @param part has each face together with all that repeat it.
void find_repetitions(const MeshPart& part, const Topology& topology, std::vector<Repetition>& found);

/// Faces of a range that repeat others of the mesh, and take no part in a flow.
struct RepeatedFaces {
    /// Ascending, in the range as it was.
    std::vector<Index> faces;
    /// One entry per face: the first face with these corners, as numbered in the whole mesh as it was.
    std::vector<std::int64_t> firsts;
};

/// Takes the faces that repeat others out of the ranges of all ranks. All ranks call this together.
/// @param own what this rank has found. @param labels of the range, if any, lose the same faces.
/// @param left_out gets what the range of this rank has lost.
/// @returns whether there were any, at any rank.
bool leave_out_repeated(Communicator& comm, const std::vector<Repetition>& own, RankSlice& slice,
                        std::optional<std::vector<Index>>& labels, RepeatedFaces& left_out);

/// The labels of all faces of a range as it was: those that were left out have that of the face that they repeat. All
/// ranks call this together.
/// @param slice as cut_together has left it.
std::vector<Index> labels_of_all_faces(Communicator& comm, const RankSlice& slice, const RepeatedFaces& left_out);

}  // namespace seamflow
