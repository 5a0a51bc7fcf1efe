#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow::test {

/// A flat grid of m by n unit squares in the plane z = 0.
PolygonMesh quad_grid(Index m, Index n);

/// The same, each square divided into two triangles.
PolygonMesh triangle_grid(Index m, Index n);

/// A closed torus of m by n quads, m and n at least 3.
PolygonMesh quad_torus(Index m, Index n);

/// The same, each quad divided into two triangles.
PolygonMesh triangle_torus(Index m, Index n);

/// An open cylinder of m quads around and n along, m at least 3.
PolygonMesh cylinder(Index m, Index n);

/// A Möbius band of m by n quads, m and n at least 3, that joins its ends with a half-turn.
PolygonMesh moebius_band(Index m, Index n);

/// A cylinder of m by n quads whose lower rim is closed by one polygon, not flat.
PolygonMesh cup(Index m, Index n);

/// A flat sheet of m by n hexagons; those at two sides have open neighbours on zigzag edges.
PolygonMesh hexagon_sheet(Index m, Index n);

/// Two quads that touch in one vertex only.
PolygonMesh bow_tie();

/// Three triangles on one edge.
PolygonMesh three_wings();

/// Two closed tetrahedra with one vertex in common.
PolygonMesh hourglass();

/// All meshes in one, side by side, sharing nothing.
PolygonMesh side_by_side(const std::vector<PolygonMesh>& meshes);

/// The same, each where it is.
PolygonMesh together(const std::vector<PolygonMesh>& meshes);

/// A noisy sphere of radius `size`.
PolygonMesh ball(double size, const Point& centre, Index vertices);

/// The mesh with about every second face turned round, at random.
PolygonMesh with_faces_flipped(const PolygonMesh& mesh, std::uint32_t seed);

/// The mesh with seams where faces of different labels meet: the faces of the second label at a vertex get a copy of
/// it, those of the third another one. Copies come after all vertices.
/// @param labels #F.
PolygonMesh split(const PolygonMesh& mesh, const std::vector<Index>& labels);

/// Labels of faces: 0 where the first corner lies at an x below the middle, else 1.
std::vector<Index> halves(const PolygonMesh& mesh, double middle = 0.5);

/// For each vertex of a split mesh, that of the whole one.
std::vector<Index> originals(const PolygonMesh& parts, const PolygonMesh& whole);

/// A mesh with a name for the messages of tests.
struct NamedMesh {
    std::string name;
    PolygonMesh mesh;
    Topology topology;
};

/// A mesh without a name.
inline NamedMesh with_topology(PolygonMesh mesh)
{
    Topology topology = make_topology(mesh);
    return {"", std::move(mesh), std::move(topology)};
}

/// One mesh of each sort, small, manifold or not, of one component or several.
std::vector<NamedMesh> assorted_meshes();

/// Labels from 0 to k - 1, uniformly random.
std::vector<Index> random_labels(Index n_faces, Index k, std::uint32_t seed);

}  // namespace seamflow::test
