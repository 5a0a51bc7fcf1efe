#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Bounds of the distances along a surface from some vertices, each #V.
namespace seamflow {

/// Distances along edges, found by Dijkstra's algorithm. They are upper bounds.
struct EdgePaths {
    /// #V: the distance, infinite where no path leads; and the source vertex of the path, or -1.
    std::vector<double> length;
    std::vector<Index> from;
};

/// @param from the source vertices.
EdgePaths paths_along_edges(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> from);

/// #V: for vertices that have a face with a source, the straight distance to the nearest source in their faces;
/// infinite elsewhere.
/// @param from the source vertices.
std::vector<double> straight_within_faces(const PolygonMesh& mesh, const Topology& topology,
                                          std::span<const Index> from);

/// #V: the straight distance of each vertex to the nearest source, which is a lower bound; 0 if sources and vertices
/// have more than 10⁹ pairs, for which it would take too long.
/// @param from the source vertices.
std::vector<double> straight_distances(const PolygonMesh& mesh, std::span<const Index> from);

}  // namespace seamflow
