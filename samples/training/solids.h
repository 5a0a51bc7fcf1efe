#pragma once

#include <optional>

#include "partition/polygon_mesh.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

/// How a solid is built up and meshed.
struct SolidShape {
    /// How often another body is added, taken away or cut with, at most.
    int most_operations = 4;
    /// Edges at larger angles, in degrees, stay sharp.
    double sharp_angle = 22.0;
    /// Whether rounds of remeshing may take no notice of sharp edges.
    bool may_blur = false;
    /// Whether parallel grooves may be cut.
    bool may_have_grooves = true;
    /// About how many triangles.
    int least_faces = 3'000;
    int most_faces = 9'000;
};

/// A closed surface of triangles, about 2 long, made of prisms, cones, stars, ellipsoids and tori. Its triangles are
/// about as long everywhere, or shorter in some places than in others, or from midpoint subdivision; in one solid out
/// of four all are stretched along one axis.
/// @returns nothing where the bodies could not be cut with each other or meshed.
std::optional<PolygonMesh> make_solid(const SolidShape& shape, RandomNumbers& random);

/// Collapses edges where they matter least (Garland and Heckbert, Surface simplification using quadric error metrics,
/// 1997): triangles become large where the surface is flat.
/// @param part of its edges that stay.
void decimate(PolygonMesh& mesh, double part);

}  // namespace seamflow
