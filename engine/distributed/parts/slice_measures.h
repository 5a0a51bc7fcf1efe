#pragma once

#include <cstdint>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/metrics/length_statistics.h"

/// Measures of a mesh that no rank has as a whole. The bits are those of one machine, for any number of ranks whose
/// ranges begin at multiples of block_size. All ranks call these functions together.
namespace seamflow {

/// The sizes of a mesh by which sub-meshes and time steps are measured, as in MeshSize and extent_of.
struct SharedMeshSize {
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    /// Of all faces, length².
    double area = 0.0;
    /// Average length of the edges, those between two faces counting twice.
    double mean_edge = 0.0;
    /// Of the bounding box of all vertices.
    double diagonal = 0.0;
};

/// @throws InputError naming the face with a corner that is not a vertex of the mesh.
SharedMeshSize measure(Communicator& comm, const RankSlice& slice);

/// How far vertices have moved.
/// @param before, after of this rank's range.
LengthStatistics measure_moves(Communicator& comm, const Points& before, const Points& after);

}  // namespace seamflow
