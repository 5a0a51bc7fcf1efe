#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A few faces of a mesh as a mesh of its own.
struct MeshPiece {
    /// Its vertices have the positions that were given.
    PolygonMesh mesh;
    /// With twins, and the kinds and held vertices of the whole mesh.
    Topology topology;
    /// #F and #V of the piece, ascending: their numbers in the whole mesh.
    std::vector<Index> faces;
    std::vector<Index> vertices;
};

/// @param topology twins are not used. @param positions #V by 3. @param faces ascending.
MeshPiece cut_out(const PolygonMesh& mesh, const Topology& topology, const Points& positions, std::vector<Index> faces,
                  const Executor& exec = run_serially);

/// How faces are divided into pieces.
struct PieceSizes {
    /// Of a piece before it grows, about. As many faces or fewer are one piece, which does not grow.
    Index most_faces = 1'000'000;
    /// How far pieces grow, so that they overlap: in rings of faces. With 16, denoised normals of six meshes cut into
    /// three and six pieces differed from those of the whole mesh no more than if its faces came in another order,
    /// which changes the rounding.
    int overlap = 16;
};

/// Divides faces into compact pieces (see divide_into_boxes) and does something with each of them, one after the other:
/// what takes much memory takes no more than for one piece.
/// @param positions #V by 3, all finite. @param faces ascending; pieces grow into no others.
/// @param action called with each piece and, #F of the piece, 1 for the faces that it had before it grew. Every face is
///        such a face of one piece.
void for_each_piece(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                    std::vector<Index> faces, const PieceSizes& sizes, const Executor& exec,
                    const std::function<void(const MeshPiece&, std::span<const std::uint8_t> is_own)>& action);

}  // namespace seamflow
