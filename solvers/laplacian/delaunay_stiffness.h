#pragma once

#include <optional>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A surface in triangles whose K has no positive entry off its diagonal, so that (M + dt K) X = M D has X in the range
/// of D for any dt.
struct DelaunaySurface {
    /// The vertices of the surface, and triangles between them. These have lengths of their own: positions say nothing
    /// of their size.
    PolygonMesh mesh;
    /// Per triangle, ascending: the face of the surface that it came from.
    std::vector<Index> face_of;
    GivenStiffness stiffness;
};

/// Makes the weights of a surface, -K_vw, at least 0. Polygons are cut by diagonals. Edges are flipped within the
/// surface until they are Delaunay there (Bobenko and Springborn, A Discrete Laplace-Beltrami Operator for Simplicial
/// Surfaces, 2007; lengths and angles of the surface stay). K has the cotangents of these triangles, M a third of their
/// areas at each corner. Edges that cannot be flipped are those of the boundary, of three faces or more, and those
/// whose flip would join two vertices twice, or leave a triangle without area in space. Where the weight of such an
/// edge is below 0, the obtuse triangles at it are softened: K of a triangle is that of the slope along its longest
/// edge, and of the bend across it; the bend counts less, so far that the weight is 0. On the boundary, across which
/// nothing flows, a bend is small.
/// @param topology says which vertices move; entries between others do not count.
/// @param laplacian Δ_A or Δ_B; for others there is no result.
/// @param in_faces whether the weights in each face alone are to be at least 0, too.
/// @returns nothing if K is so already, but for weights above -1e-8.
std::optional<DelaunaySurface> make_delaunay(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian,
                                             bool in_faces, const Executor& exec = run_serially);

}  // namespace seamflow
