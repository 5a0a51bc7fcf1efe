#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

/// Bounds of the distances along a surface from some vertices, each #V.
namespace seamflow {

/// Distances along edges, which are too long, by the algorithm of Dijkstra.
struct EdgePaths {
    /// #V: infinite where no path leads; and the vertex from which the path comes, or -1.
    std::vector<double> length;
    std::vector<Index> from;
};

/// @param from vertices of the mesh.
EdgePaths paths_along_edges(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> from);

/// Straight distances from the vertices of whose faces some are: to the nearest of these. Infinite elsewhere.
std::vector<double> straight_within_faces(const PolygonMesh& mesh, const Topology& topology,
                                          std::span<const Index> from);

/// The straight distance of each vertex to the nearest of some, which is too short; 0 if they are very many.
std::vector<double> straight_distances(const PolygonMesh& mesh, std::span<const Index> from);

}  // namespace seamflow
