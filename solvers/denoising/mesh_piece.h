#pragma once

#include <cstdint>
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

/// Divides faces among boxes of about equally many vertices.
/// @param positions #V by 3, all finite. @param n_boxes as in divide_into_boxes.
/// @returns #F: the box of each face.
std::vector<Index> boxes_of_faces(const PolygonMesh& mesh, const Points& positions, Index n_boxes,
                                  const Executor& exec = run_serially);

}  // namespace seamflow
