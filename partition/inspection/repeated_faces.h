#pragma once

#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A face with the same vertices as one before it, in whatever order.
struct RepeatedFace {
    Index face;
    /// The first face with these vertices.
    Index first;
};

/// Those among the candidates that repeat another candidate, in ascending order.
/// @param candidates faces, ascending.
std::vector<RepeatedFace> find_repeated_faces(const PolygonMesh& mesh, const std::vector<Index>& candidates);

}  // namespace seamflow
