#pragma once

#include <optional>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A surface in triangles whose K has no positive entry off its diagonal, so that the X of (M + dt K) X = M D is within
/// the range of D for any dt.
struct DelaunaySurface {
    /// The vertices of the surface, and triangles between them. The triangles have lengths of their own, which are not
    /// those between the positions of the vertices.
    PolygonMesh mesh;
    /// Per triangle, ascending: the face of the surface from which it came.
    std::vector<Index> face_of;
    GivenStiffness stiffness;
};

/// Makes the weights of a surface, -K_vw, at least 0. Polygons are cut by diagonals. Edges are flipped within the
/// surface until they are Delaunay there (Bobenko and Springborn, A Discrete Laplace-Beltrami Operator for Simplicial
/// Surfaces, 2007; lengths and angles of the surface do not change). K has the cotangents of these triangles, M a third
/// of their areas at each corner. Edges of the boundary, edges of three faces or more, and edges whose flip would join
/// two vertices twice, or leave a triangle without area in space, are not flipped. If the weight of such an edge is
/// below 0, the obtuse triangles at it are softened: K of a triangle is the sum of two terms, of the slope along its
/// longest edge and of the bend across it; the term of the bend is reduced until the weight is 0. On the boundary,
/// across which nothing flows, a bend is small.
/// @param topology with the vertices that move; entries between other vertices do not matter.
/// @param laplacian AlexaWardetzky or VirtualRefinement; for other Laplacians there is no result.
/// @param in_faces whether the weights in each single face must also be at least 0.
/// @returns nothing if all weights are above -1e-8 already.
std::optional<DelaunaySurface> make_delaunay(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                             bool in_faces, const Executor& exec = run_serially);

}  // namespace seamflow
