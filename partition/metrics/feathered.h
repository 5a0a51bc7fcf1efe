#pragma once

#include <optional>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The distances of vertices from the nearest of some vertices along the surface, by fast marching over the faces
/// (Kimmel, Sethian, Computing geodesic paths on manifolds, 1998), along edges and diagonals of faces where that fails:
/// exact from straight rims on flat triangles that are not obtuse, about a tenth too long elsewhere.
/// @param topology of the mesh. @param sources in any order.
/// @returns #V, in length; infinite at vertices that are not connected to a source, or farther than `most`.
std::vector<double> distances_from(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> sources,
                                   double most);

/// Lets the strength in a region rise smoothly from 0 at its rim, where vertices of strength 0 are next to others, to
/// the full value at a distance from it: by 10 t³ - 15 t⁴ + 6 t⁵, t = distance / length. (With a rise by t², a flow
/// would leave a crease, because dt over the squared distance is then the same all the way to the rim.) The boundary of
/// the mesh is no rim. Vertices that are joined along a seam count as one vertex, with the smallest of their
/// strengths.
/// @param strength #V, at least 0. @param length of the rise; 0: strengths stay as they are.
/// @param joined_within how far apart vertices along seams may be (see weld); empty: they are not joined.
/// @returns #V.
/// @throws InputError if there is not one strength for each vertex; OptionError if the length is negative or not
/// finite.
std::vector<double> feathered(const PolygonMesh& mesh, std::vector<double> strength, double length,
                              std::optional<double> joined_within = 0.0, const Executor& exec = run_serially);

}  // namespace seamflow
