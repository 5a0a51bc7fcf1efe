#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// A box around positions, in units of length.
struct BoundingBox {
    Point low = Point::Zero();
    Point high = Point::Zero();

    /// From corner to corner, in units of length.
    [[nodiscard]] double diagonal() const { return (high - low).norm(); }
};

/// The box around the vertices that faces use; others may lie anywhere. Positions that are not finite are left out. A
/// point where nothing is left.
/// @param positions #V by 3. @pre every vertex named by a face exists.
BoundingBox box_of_faces(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The same where it is known already which vertices these are.
/// @param is_used #V (see used_by_faces).
BoundingBox box_of_vertices(const Points& positions, std::span<const std::uint8_t> is_used,
                            const Executor& exec = run_serially);

/// The same for the mesh's own positions.
BoundingBox box_of_faces(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// @returns those of some vertices that lie further from the box around the faces than its diagonal is long.
/// @param vertices without faces, ascending.
std::vector<Index> far_from_faces(const PolygonMesh& mesh, std::span<const Index> vertices,
                                  const Executor& exec = run_serially);

}  // namespace seamflow
