#pragma once

#include <span>
#include <vector>

#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The boundary of a surface, or a piece of it, as a curve: vertices of kind Boundary in their order along edges of one
/// face.
struct RimCurve {
    std::vector<Index> vertices;
    /// The face at the edge from each vertex to the next one; of a closed curve also at the edge from the last vertex
    /// to the first.
    std::vector<Index> faces;
    /// One per face: 1 if the edge runs along the curve in the face, -1 if against it.
    std::vector<double> senses;
    bool is_closed = false;
};

/// Finds the curves of the boundary. They end where the boundary touches itself, and where it meets an edge of three
/// faces or more.
/// @param topology with twins.
std::vector<RimCurve> find_rim_curves(const PolygonMesh& mesh, const Topology& topology);

/// A smoothed curve.
struct SmoothCurve {
    /// One row per vertex, by 3.
    Points positions;
    /// One per vertex: near 0 at corners, near 1 elsewhere.
    std::vector<double> smoothness;
};

/// Minimises Σ m_i |x_i - p_i|² + (2R/π)⁴ Σ w_i |b_i|² / m_i, with the length m_i of the curve at a vertex and b_i =
/// (x_{i+1} - x_i) / h_i - (x_i - x_{i-1}) / h_{i-1}, h being the lengths of edges: the biharmonic smoothing of a
/// curve, which halves bumps of radius R (see smoothed_radius) and hardly shrinks larger shapes. The ends of open
/// curves stay.
/// @param positions p: one per vertex, by 3. @param radius R, in units of length.
/// @param keeps_corners whether the weights w are small where the curve bends by more than 0.6 radians within R: the
/// weights are found in a few rounds. Otherwise all are 1.
SmoothCurve smooth_curve(const RimCurve& curve, const Points& positions, double radius, bool keeps_corners);

/// The directions across a curve.
/// @param normals #F by 3: of the faces, of any length.
/// @returns one per vertex of the curve: of length 1, within the surface and at right angles to the curve; 0 where
/// there is no such direction.
Points across_curve(const RimCurve& curve, const Points& positions, const Points& normals);

/// Shortens the motions of the vertices of faces that would turn over or keep less than a tenth of their areas: near a
/// curve, a face with two edges of the boundary has hardly any area.
/// @param normals #F by 3: of the surface, of any length. Faces that have turned away from them before do not matter.
/// @param motions #V by 3; replaced.
void keep_areas(const PolygonMesh& mesh, const Points& positions, const Points& normals, Points& motions);

/// Moves the surface within a band along its boundary together with the boundary: motions fall to 0 over a few times
/// the length of the largest motion of their curve, and have no component along the normals, so that faces keep their
/// shapes and the surface does not move.
/// @param topology needs no twins. @param curves all curves that move. @param normals of the mesh. @param positions #V
/// by 3.
/// @param motions #V by 3. In: the motions of the vertices of curves, and 0 elsewhere. Out: the motions of all
/// vertices. Fixed vertices do not move.
void spread_into_band(const PolygonMesh& mesh, const Topology& topology, std::span<const RimCurve> curves,
                      const VertexNormals& normals, const Points& positions, Points& motions);

}  // namespace seamflow
