#pragma once

#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A face with the same vertices as an earlier one, in any order.
struct RepeatedFace {
    Index face;
    /// The first face with these vertices.
    Index first;
};

/// The faces among the candidates that repeat an earlier candidate, in ascending order.
/// @param candidates faces, ascending.
std::vector<RepeatedFace> find_repeated_faces(const PolygonMesh& mesh, const std::vector<Index>& candidates);

}  // namespace seamflow
