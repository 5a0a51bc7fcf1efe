#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/vector_area.h"

namespace seamflow {

/// A box around positions, in units of length.
struct BoundingBox {
    Point low = Point::Zero();
    Point high = Point::Zero();

    /// The length from corner to corner, in units of length.
    [[nodiscard]] double diagonal() const { return (high - low).norm(); }
};

/// The bounding box of the vertices that faces use. Positions that are not finite are ignored. If no position is left,
/// the box is the origin.
/// @param positions #V by 3. @pre every vertex named by a face exists.
BoundingBox box_of_faces(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The bounding box of given vertices.
/// @param is_used #V (see used_by_faces).
BoundingBox box_of_vertices(const Points& positions, std::span<const std::uint8_t> is_used,
                            const Executor& exec = run_serially);

/// The bounding box of the vertices that faces use, at the mesh's own positions.
BoundingBox box_of_faces(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The vertices whose distance to the box around the faces is larger than its diagonal.
/// @param vertices without faces, ascending.
std::vector<Index> far_from_faces(const BoundingBox& of_faces, const Points& positions,
                                  std::span<const Index> vertices);

/// A sentence for the user about vertices that count in no length because no face uses them.
/// @param vertices far from all faces: at least one, ascending.
Remark remark_on_far_vertices(const std::vector<Index>& vertices);

}  // namespace seamflow
