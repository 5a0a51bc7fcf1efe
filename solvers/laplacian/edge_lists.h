#pragma once

#include <compare>
#include <span>
#include <vector>

#include "partition/index_lists.h"

namespace seamflow {

/// Two different vertices.
struct VertexPair {
    Index first = 0;
    Index second = 0;
    friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

/// The faces whose contributions a SymmetricLaplacian sums up.
enum class Contributions {
    /// The faces on both sides of Γ: sums are complete at all vertices of the sub-mesh.
    BothSides,
    /// The own faces only, each side having half of an edge on Γ: the sums over all sub-meshes are complete.
    OwnFaces,
};

/// Faces of a sub-mesh, and faces beyond its Γ.
struct FacesOnBothSides {
    IndexListsView own;
    IndexListsView beyond;
    /// Per half-edge of an own face: its twin in an own face, or -1 (see SubMesh::twin).
    std::span<const Index> twin;
    /// The number of all local vertices.
    Index n_vertices;
    Contributions contributions = Contributions::BothSides;
};

/// Edges by the number of their faces in a set, each of which has half of the edge: an edge of k faces is listed k / 2
/// times among the inner edges, rounded down, and once more among the rim edges if k is odd.
struct OuterEdges {
    /// Edges between two faces.
    std::vector<VertexPair> inner;
    /// Edges of one face. A rim edge at a vertex that may move is on the boundary of the whole mesh, or at a junction.
    std::vector<VertexPair> rim;
};

/// The edges of own faces on the rim of the sub-mesh, and all edges of the faces beyond, ascending.
OuterEdges list_outer_edges(const FacesOnBothSides& faces);

/// Appends the edges between two own faces, or the edges on the rim of the sub-mesh, each once.
void append_own_edges(const FacesOnBothSides& faces, bool on_rim, std::vector<VertexPair>& edges);

}  // namespace seamflow
