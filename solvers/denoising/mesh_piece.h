#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Some faces of a mesh as a mesh of their own.
struct MeshPiece {
    /// The piece, with the given positions.
    PolygonMesh mesh;
    /// With twins and, if the whole mesh has them, junctions; with the kinds and the fixed vertices of the whole mesh.
    Topology topology;
    /// #F and #V of the piece: the numbers of its faces and vertices in the whole mesh, ascending.
    std::vector<Index> faces;
    std::vector<Index> vertices;
};

/// Some faces of a mesh as a mesh of their own.
/// @param topology twins are not used. @param positions #V by 3. @param faces ascending.
MeshPiece cut_out(const PolygonMesh& mesh, const Topology& topology, const Points& positions, std::vector<Index> faces,
                  const Executor& exec = run_serially);

/// How faces are divided into pieces.
struct PieceSizes {
    /// The approximate number of faces of a piece before it grows. Up to so many faces in all are one piece, which does
    /// not grow.
    Index most_faces = 1'000'000;
    /// The number of rings of faces by which a piece grows, so that pieces overlap. With 16, denoised normals of six
    /// meshes cut into three and six pieces differed from those of the whole mesh no more than if its faces came in
    /// another order, which changes the rounding.
    int overlap = 16;
};

/// Divides faces into compact pieces (see divide_into_boxes) and calls action for one piece after the other, so that
/// action needs memory for one piece at a time.
/// @param positions #V by 3, all finite. @param faces ascending; pieces grow into no other faces.
/// @param action called with each piece and, per face of the piece, 1 for the faces that it had before it grew. Each
/// face was in exactly one piece before the pieces grew.
void for_each_piece(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                    std::vector<Index> faces, const PieceSizes& sizes, const Executor& exec,
                    const std::function<void(const MeshPiece&, std::span<const std::uint8_t> is_own)>& action);

}  // namespace seamflow
