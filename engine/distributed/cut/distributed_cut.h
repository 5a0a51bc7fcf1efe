#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/distributed/cut/joined_seams.h"
#include "engine/distributed/cut/repeated_faces.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// How a mesh is taken apart to be cut. It decides the cut, together with the mesh and the options.
struct CutUnits {
    /// About how many faces a rank handles at once; at least 1.
    Index faces_of_chunk = 1 << 18;
    /// The most chunks whose clusters METIS divides at once; at least 1. This many of the size above make a mesh of 10⁸
    /// vertices.
    Index chunks_of_block = 768;
};

/// The result of cutting a mesh that no rank has as a whole.
struct DistributedCut {
    Index n_parts = 0;
    /// How many faces had to be moved to other parts to make every part a manifold.
    std::int64_t repaired_faces = 0;
    /// A sentence on the choice of n_parts; empty if the options give the number.
    std::string choice = {};
    /// What the user should know about the cut, one sentence each.
    std::vector<std::string> remarks = {};
    /// What the range no longer has.
    RepeatedFaces left_out = {};
    /// Which of the vertices along seams no longer have faces, as others move for them.
    JoinedSeams seams = {};
};

/// Cuts a mesh as its options say: into CutOptions::subdomains, or as many as suit its size and the step. Meshes of no
/// more faces than a chunk are cut by one rank as cut_into does. Larger ones are sorted along Hilbert's curve and
/// divided into chunks, in which clusters of faces grow; METIS divides the graphs of their clusters, each block of
/// chunks at one rank, and what must be mended goes to rank 0 with the faces around it. All ranks call this together;
/// the cut does not depend on their number.
/// @param slice its seams are joined (see MotionOptions::weld), it loses the faces that repeat others (see
/// FlowingMesh),
///        and gets labels, from 0 to n_parts - 1.
/// @returns the same at all ranks, except what their ranges lost.
/// @throws InputError naming a face with a corner that is not a vertex of the mesh; OptionError; ComputationError if
///         METIS fails.
DistributedCut cut_together(Communicator& comm, RankSlice& slice, const FlowOptions& options,
                            const CutUnits& units = {});

/// Cuts a mesh as given (see cut_by_labels).
/// @param slice its labels, at least 0, are compacted and mended.
DistributedCut cut_together_by_labels(Communicator& comm, RankSlice& slice, const FlowOptions& options,
                                      const CutUnits& units = {});

}  // namespace seamflow
