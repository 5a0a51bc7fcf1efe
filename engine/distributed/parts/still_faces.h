#pragma once

#include <span>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/measure/bounding_box.h"

namespace seamflow {

/// Takes faces out of a range, with their labels, if there are any.
/// @param faces ascending.
void leave_out(std::span<const Index> faces, RankSlice& slice);

/// Labels without those of some faces.
/// @param faces ascending.
std::vector<Index> labels_without(const std::vector<Index>& labels, std::span<const Index> faces);

/// The labels before labels_without: those faces get the given one.
std::vector<Index> labels_with(const std::vector<Index>& labels, std::span<const Index> faces, Index label);

/// What is known of the faces that leave_out_still_faces takes out of a range.
struct StillFaces {
    /// Ascending, in the range as it was.
    std::vector<Index> faces;
    /// The box around all faces of the mesh as it was; see MeshPart::box.
    BoundingBox box;
    /// Of the faces taken out of all ranges, length².
    double area = 0.0;
    /// Of the whole mesh: the faces that are left.
    std::int64_t n_left = 0;
};

/// Takes the faces out of the ranges of all ranks on which no row of a moving vertex depends, as a flow on one machine
/// does (see FlowingMesh), for Laplacians whose rows reach one ring. All ranks call this together.
/// @param strengths of the vertices of this rank's range (see MotionOptions::strength).
StillFaces leave_out_still_faces(Communicator& comm, std::span<const double> strengths, RankSlice& slice);

}  // namespace seamflow
