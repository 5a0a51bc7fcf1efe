#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// A range of a mesh's vertices and one of its faces, as a rank reads them from a file or writes them to it. Those of
/// all ranks, in their order, make up the mesh.
struct RankSlice {
    /// Positions, #V of the range by 3.
    Points vertices = Points(0, 3);
    /// #F of the range + 1, as in PolygonMesh; and the corners, numbered in the whole mesh.
    std::vector<Index> face_offsets{0};
    std::vector<std::int64_t> corners;
    /// #F: the sub-mesh of every face, at least 0.
    std::vector<Index> labels;
    /// How many of the vertices are without faces since leave_out_still_faces: they do not count for a cut.
    Index n_still = 0;

    [[nodiscard]] Index n_faces() const { return static_cast<Index>(face_offsets.size()) - 1; }
};

/// Where the ranges of all ranks begin: #ranks + 1.
struct SliceBounds {
    std::vector<std::int64_t> vertices;
    std::vector<std::int64_t> faces;
};

/// The ranges in order. All ranks call this together.
SliceBounds gather_bounds(Communicator& comm, const RankSlice& slice);

/// Checks that the corners of a range are vertices of the mesh.
/// @throws InputError naming the first face of this rank that fails.
void require_corners(const RankSlice& slice, const SliceBounds& bounds, int rank);

/// The range in which a number lies.
/// @param bounds of vertices or faces (see SliceBounds), the number within them.
int range_of(std::span<const std::int64_t> bounds, std::int64_t number);

/// Rows of numbers, one for each vertex of a rank's range.
struct RowsOfRange {
    std::span<const double> numbers;
    /// How many numbers a row has.
    std::ptrdiff_t width = 1;
};

/// Fetches rows of vertices from the ranks that have them. All ranks call this together.
/// @param numbers ascending, in the whole mesh. @param bounds those of vertices.
/// @param fetched receives the rows, one after the other.
void fetch_rows(Communicator& comm, const RowsOfRange& rows, std::span<const std::int64_t> numbers,
                std::span<const std::int64_t> bounds, std::span<double> fetched);

/// The same for the positions of vertices. All ranks call this together.
/// @returns #numbers by 3.
Points fetch_positions(Communicator& comm, const RankSlice& slice, std::span<const std::int64_t> numbers,
                       std::span<const std::int64_t> bounds);

/// Gives every face to the rank that has its sub-mesh, with the positions of its corners. Sub-meshes are dealt in
/// ascending order, so that all ranks get about equally many corners. All ranks call this together; no rank holds more
/// than its slice and its part.
/// @param short_up_to up to this many vertices and faces, their numbers are sent in 32 bits, which they must fit.
/// @throws InputError naming the face with a corner that is not a vertex of the mesh, or with a negative label.
MeshPart deal(Communicator& comm, const RankSlice& slice, std::int64_t short_up_to = std::numeric_limits<Index>::max());

/// Puts the positions of all parts into the ranges of vertices to which they belong. All ranks call this together.
/// @param numbers of the vertices of a part, as it was dealt. @param positions correspond; those of a vertex that
/// several
///        ranks have are the same.
/// @param slice as it was dealt out: vertices without faces keep their positions.
void collect_positions(Communicator& comm, std::span<const std::int64_t> numbers, const Points& positions,
                       RankSlice& slice);

}  // namespace seamflow
