#pragma once

#include <vector>

#include "partition/metrics/length_statistics.h"
#include "partition/metrics/vertex_normals.h"

namespace seamflow {

/// The motion of a vertex from one state of a mesh to another, in units of length, split into a normal component, which
/// changes the shape, and a tangential component, which only drags the texture along the surface.
struct Displacement {
    Point tangential = Point::Zero();
    /// The component along the normal, negative against it.
    double normal = 0.0;
    /// False for a vertex that has no normal in either state, or that turned over: both components are 0 then.
    bool defined = false;
};

/// Splits the displacement V′ − V of a vertex along the direction n + n′, the sum of the unit normals of both states.
/// With the normal of one state alone, the sagitta of every finite motion along a curved surface would count as a
/// normal component; with n + n′ any rotation of a sphere about its centre is tangential, and neither state is
/// preferred.
/// @param normal_before, normal_after n and n′, of length 1, or 0 if there is no normal: then only the other one is
/// used.
Displacement split_displacement(const Point& displacement, const Point& normal_before, const Point& normal_after);

/// The components of the displacements of all vertices.
struct DisplacementField {
    /// #V: the length of the tangential component, and the signed normal component, in units of length; NaN where the
    /// split is not defined.
    std::vector<double> tangential;
    std::vector<double> normal;
};

/// Displacements from `before` to `after`, #V by 3 each, of the vertices of `mesh`.
/// @throws InputError if the numbers of vertices differ.
DisplacementField displacement_field(const PolygonMesh& mesh, const Points& before, const Points& after);

/// Statistics of both components over all vertices where they are defined, including vertices that do not move.
DisplacementStatistics displacement_statistics(const DisplacementField& field);

}  // namespace seamflow
