#pragma once

#include <array>
#include <string>
#include <vector>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// An edge by its two vertices, the lower number first.
using Edge = std::array<Index, 2>;

/// What is uncommon or wrong about a mesh, element by element. All numbers count from 0; all lists are ascending.
struct MeshInspection {
    Index vertices = 0;
    Index faces = 0;
    Index edges = 0;
    /// How many faces have 3, 4, 5, 6 and more sides.
    std::array<Index, 5> faces_by_sides{};
    /// Connected through edges of two faces.
    Index components = 0;
    /// Edges of one face.
    Index boundary_edges = 0;
    /// Shortest, mean (over half-edges) and longest edge, in units of length.
    double shortest_edge = 0.0;
    double mean_edge = 0.0;
    double longest_edge = 0.0;
    /// Of the bounding box of all vertices: its middle, and the length of its diagonal.
    std::array<double, 3> middle{};
    double diagonal = 0.0;

    /// Vertices with a coordinate that is no finite number. What is measured leaves them and their edges and faces out.
    std::vector<Index> vertices_not_finite;
    /// Edges of three faces or more.
    std::vector<Edge> non_manifold_edges;
    /// Vertices on such edges, and those around which faces form several fans.
    std::vector<Index> non_manifold_vertices;
    /// Edges whose two faces run along them in the same direction: they are oriented against each other.
    std::vector<Edge> inconsistent_edges;
    /// Whether faces could be turned so that there are none of those; a Möbius band's cannot.
    bool orientable = true;
    /// Faces that have the same vertices as a face before them, in whatever order.
    std::vector<Index> duplicate_faces;
    /// Faces whose vector area is no normal double, or smaller than rounding of their coordinates leaves.
    std::vector<Index> faces_without_area;
    /// Edges whose length is no normal double.
    std::vector<Edge> edges_without_length;
    /// Vertices at the same place as a vertex before them.
    std::vector<Index> coincident_vertices;
    /// Vertices without faces.
    std::vector<Index> isolated_vertices;
    /// How many of the bits of a double are left for detail of the size of the mean edge at the distance from the
    /// origin at which the mesh lies; of 53. A file with floats keeps 29 fewer.
    int bits_for_detail = 53;
};

/// Examines a mesh. Near to linear in its size.
/// @param mesh valid (see require_valid), but that coordinates need not be finite.
MeshInspection inspect(const PolygonMesh& mesh, const Topology& topology, const Loop& loop = run_serially);

}  // namespace seamflow
