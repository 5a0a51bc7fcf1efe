#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "partition/cracks.h"
#include "partition/executor.h"
#include "partition/metrics/self_intersections.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Element counts of a mesh.
struct ElementCounts {
    Index vertices = 0;
    Index faces = 0;
    Index edges = 0;
    /// The numbers of faces with 3, 4, 5, 6, and more sides.
    std::array<Index, 5> faces_by_sides{};
    /// The number of components, connected through edges of two faces; faces with the same vertices count once.
    Index components = 0;
    /// The number of edges with one face.
    Index boundary_edges = 0;
    /// The number of pairs of boundary edges that coincide along seams, and of the duplicated vertices at their ends
    /// (see weld).
    Index seam_edges = 0;
    Index seam_vertices = 0;
};

/// Lengths of edges, in units of length; the mean is over half-edges.
struct EdgeLengths {
    double shortest = 0.0;
    double mean = 0.0;
    double longest = 0.0;
};

/// The bounding box of the vertices that faces use: its middle, and the length of its diagonal.
struct MeshBox {
    std::array<double, 3> middle{};
    double diagonal = 0.0;
};

/// The unusual or faulty elements. All numbers count from 0; all lists are ascending, and edges have the lower vertex
/// first.
struct MeshDefects {
    /// Vertices with a coordinate that is not finite. Measurements ignore these vertices and their edges and faces.
    std::vector<Index> vertices_not_finite;
    /// Edges of three faces or more.
    std::vector<Edge> non_manifold_edges;
    /// Vertices on such edges, and vertices whose faces form several fans, none of them open (see
    /// VertexKind::NonManifold).
    std::vector<Index> non_manifold_vertices;
    /// Edges whose two faces run along them in the same direction, which means that the faces are oriented against each
    /// other.
    std::vector<Edge> inconsistent_edges;
    /// Faces that have the same vertices as an earlier face, in any order; and the number of these that run around
    /// their vertices in the other sense, as on surfaces with two sides.
    std::vector<Index> duplicate_faces;
    Index n_turned_round = 0;
    /// Faces without area, up to rounding (see area_above_rounding).
    std::vector<Index> faces_without_area;
    /// Edges whose length is not a normal double.
    std::vector<Edge> edges_without_length;
    /// Vertices with the same position as an earlier vertex.
    std::vector<Index> coincident_vertices;
    /// Vertices without faces.
    std::vector<Index> isolated_vertices;
    /// Isolated vertices whose distance to the box around the faces is larger than its diagonal.
    std::vector<Index> far_vertices;
    /// Vertices far from all of their neighbours (see find_spikes).
    std::vector<Index> spikes;
    /// Pairs of faces that cross each other (see self_intersections); of faces with the same vertices, only the first
    /// counts.
    std::vector<FacePair> self_intersections;
};

/// The composition and the defects of a mesh.
struct MeshInspection {
    ElementCounts counts;
    EdgeLengths edge_lengths;
    MeshBox box;
    MeshDefects defects;
    /// Gaps of a small fraction of an edge in the surface; nothing if there are none, or if welding does not close them
    /// (see find_cracks).
    std::optional<Cracks> cracks;
    /// Whether the faces can be oriented consistently, unlike those of a Möbius band.
    bool orientable = true;
    /// The number of bits of a double, of 53, that are left for details of the size of the mean edge at the mesh's
    /// distance from the origin. A file in single precision has 29 fewer.
    int bits_for_detail = 53;
};

/// Examines a mesh. Nearly linear in its size.
/// @param mesh valid (see require_valid), but coordinates need not be finite. @param topology before free_junctions.
MeshInspection inspect(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

/// The mesh with only the first face of each set of faces that have the same vertices: one side of a surface with two.
PolygonMesh with_single_faces(const PolygonMesh& mesh, const MeshInspection& found);

}  // namespace seamflow
