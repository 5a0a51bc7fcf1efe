#pragma once

#include <span>
#include <vector>

#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The boundary of a surface, or a part of it, as a curve: vertices of kind Boundary in their order along edges of one
/// face.
struct RimCurve {
    std::vector<Index> vertices;
    /// The face at the edge from each vertex to the next one; of a closed curve also from the last to the first.
    std::vector<Index> faces;
    /// One per face: 1 if the edge runs along the curve in the face, -1 if against it.
    std::vector<double> senses;
    bool is_closed = false;
};

/// Curves end where the boundary touches itself, and where it meets an edge of three faces or more.
/// @param topology with twins.
std::vector<RimCurve> find_rim_curves(const PolygonMesh& mesh, const Topology& topology);

/// A curve that follows another one, but bends less.
struct SmoothCurve {
    /// One per vertex, by 3.
    Points positions;
    /// One per vertex: near 0 at corners, else near 1.
    std::vector<double> smoothness;
};

/// Minimises Σ m_i |x_i - p_i|² + (2R/π)⁴ Σ w_i |b_i|² / m_i, with the length m_i of the curve at a vertex and
/// b_i = (x_{i+1} - x_i) / h_i - (x_i - x_{i-1}) / h_{i-1}: the biharmonic smoothing of a curve, which halves bumps of
/// radius R (see smoothed_radius) and hardly shrinks larger shapes. The ends of open curves stay.
/// @param positions p: one per vertex, by 3. @param radius R, in units of length.
/// @param keeps_corners whether the weights w are small where the curve bends by more than 0.6 radians within R:
///        they are found in a few rounds. Otherwise all are 1.
SmoothCurve smooth_curve(const RimCurve& curve, const Points& positions, double radius, bool keeps_corners);

/// @param normals #F by 3: of the faces, of any length.
/// @returns one per vertex of the curve: of length 1, within the surface and at right angles to the curve; 0 where
/// there is none.
Points across_curve(const RimCurve& curve, const Points& positions, const Points& normals);

/// Shortens the motions of the vertices of faces that would keep less than a tenth of their areas, or turn over: near a
/// curve, a face with two edges of the boundary has hardly any.
/// @param normals #F by 3: of the surface, of any length. Faces that turn away from them do not matter.
/// @param motions #V by 3; replaced.
void keep_areas(const PolygonMesh& mesh, const Points& positions, const Points& normals, Points& motions);

/// Lets the surface follow its boundary within a band: motions fall to 0 over a few times the length of the largest
/// of their curve, and leave out what goes along the normals, so that faces keep their shapes and the surface its
/// place.
/// @param topology needs no twins. @param curves all that move. @param normals of the mesh. @param positions #V by 3.
/// @param motions #V by 3: of the vertices of curves, and 0 elsewhere; receives those of all. Held vertices stay.
void spread_into_band(const PolygonMesh& mesh, const Topology& topology, std::span<const RimCurve> curves,
                      const VertexNormals& normals, const Points& positions, Points& motions);

}  // namespace seamflow
