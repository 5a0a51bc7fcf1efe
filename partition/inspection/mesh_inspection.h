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
    /// How many faces have 3, 4, 5, 6 and more sides.
    std::array<Index, 5> faces_by_sides{};
    /// Connected through edges of two faces; those that lie on each other count once.
    Index components = 0;
    /// Edges of one face.
    Index boundary_edges = 0;
    /// Pairs of boundary edges that coincide along seams, and the duplicated vertices at their ends (see weld).
    Index seam_edges = 0;
    Index seam_vertices = 0;
};

/// In units of length; the mean is over half-edges.
struct EdgeLengths {
    double shortest = 0.0;
    double mean = 0.0;
    double longest = 0.0;
};

/// The box around the vertices that faces use: its middle, and the length of its diagonal.
struct MeshBox {
    std::array<double, 3> middle{};
    double diagonal = 0.0;
};

/// The unusual or faulty elements. All numbers count from 0; all lists are ascending, and edges have the lower vertex
/// first.
struct MeshDefects {
    /// Vertices with a coordinate that is not finite. Measurements leave out these and their edges and faces.
    std::vector<Index> vertices_not_finite;
    /// Edges of three faces or more.
    std::vector<Edge> non_manifold_edges;
    /// Vertices on such edges, and those around which faces form several fans.
    std::vector<Index> non_manifold_vertices;
    /// Edges whose two faces run along them in the same direction: they are oriented against each other.
    std::vector<Edge> inconsistent_edges;
    /// Faces that have the same vertices as an earlier face, in any order; how many of them run around it in the other
    /// sense, as on surfaces with two sides.
    std::vector<Index> duplicate_faces;
    Index n_turned_round = 0;
    /// Faces without area, up to rounding (see area_above_rounding).
    std::vector<Index> faces_without_area;
    /// Edges whose length is no normal double.
    std::vector<Edge> edges_without_length;
    /// Vertices at the same place as an earlier one.
    std::vector<Index> coincident_vertices;
    /// Vertices without faces.
    std::vector<Index> isolated_vertices;
    /// Those of them that lie further from the box around the faces than it is large.
    std::vector<Index> far_vertices;
    /// Vertices far from all of their neighbours (see find_spikes).
    std::vector<Index> spikes;
    /// Faces that cross each other (see self_intersections); of those that lie on each other the first one counts.
    std::vector<FacePair> self_intersections;
};

/// The composition and the defects of a mesh.
struct MeshInspection {
    ElementCounts counts;
    EdgeLengths edge_lengths;
    MeshBox box;
    MeshDefects defects;
    /// Where the surface is open by a small fraction of an edge.
    std::optional<Cracks> cracks;
    /// Whether the faces can be oriented consistently; those of a Möbius band cannot.
    bool orientable = true;
    /// How many of the 53 bits of a double are left for detail of the size of the mean edge at the mesh's distance from
    /// the origin. A file with floats keeps 29 fewer.
    int bits_for_detail = 53;
};

/// Examines a mesh. Nearly linear in its size.
/// @param mesh valid (see require_valid), but coordinates need not be finite.
MeshInspection inspect(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

/// The mesh with the first one of faces that have the same vertices: one side of a surface with two.
PolygonMesh with_single_faces(const PolygonMesh& mesh, const MeshInspection& found);

/// A face with the same vertices as an earlier one, in any order.
struct RepeatedFace {
    Index face;
    /// The first face with these vertices.
    Index first;
};

/// Those among the candidates that repeat another candidate, in ascending order.
/// @param candidates faces, ascending.
std::vector<RepeatedFace> find_repeated_faces(const PolygonMesh& mesh, const std::vector<Index>& candidates);

}  // namespace seamflow
