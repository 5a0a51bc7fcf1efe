#pragma once

#include <vector>

#include "solvers/laplacian/symmetric_laplacian.h"

namespace seamflow {

/// Edges by the number of faces that they have here.
struct OuterEdges {
    /// Of several faces.
    std::vector<VertexPair> inner;
    /// Of one face. Those at a vertex that may move are on the boundary of the whole mesh.
    std::vector<VertexPair> rim;
};

/// The edges of own faces on the rim of the sub-mesh, and all edges of the faces beyond, each once and ascending.
OuterEdges list_outer_edges(const FacesOnBothSides& faces);

/// Appends the edges between two own faces, or those on the rim, each once.
void append_own_edges(const FacesOnBothSides& faces, bool on_rim, std::vector<VertexPair>& edges);

}  // namespace seamflow
