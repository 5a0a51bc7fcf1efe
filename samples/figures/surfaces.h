#pragma once

#include "partition/polygon_mesh.h"

/// Generated stand-ins for the meshes of the paper: of the same kind and, at their usual number of vertices, of the
/// same size. Their two halves (see halves_by_rows) meet in the middle.
namespace seamflow {

/// Quads, polygons or triangles over the square from -1 to 1 in x and y: bumps of one wave length 1. Most polygons have
/// four to eight corners, and three edges meet at each vertex off the boundary, as in the authors' mesh.
PolygonMesh quads_with_bumps(Index vertices);
PolygonMesh polygons_with_bumps(Index vertices);
PolygonMesh triangles_with_bumps(Index vertices);

/// Irregular hexagons over the unit square, the shortest edge about half as long as the mean one.
PolygonMesh hexagons_with_bumps(Index vertices);

/// Such polygons over the square from -1 to 1, a hill in one half and a hollow in the other: where they meet, at y =
/// 0, the surface is straight and its mean curvature small.
PolygonMesh polygons_with_hill_and_hollow(Index vertices);

/// A tube of quads along z, from -π to π, in one wave that is three times as wide at z = 0, where the two halves of the
/// mesh meet, as at its ends: 120 columns of quads, if it has 10,200 vertices.
PolygonMesh wavy_cylinder(Index vertices);

/// A noisy, bulging tube of quads from z = -π to π, its upper half twice as fine as the lower one, with a ring of
/// pentagons in between that belongs to the lower half.
PolygonMesh bulging_two_level_cylinder(Index vertices);

}  // namespace seamflow
