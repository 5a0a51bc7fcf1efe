#pragma once

#include <vector>

#include "partition/metrics/length_statistics.h"
#include "partition/metrics/vertex_normals.h"

namespace seamflow {

/// How a vertex moved from one state of a mesh to another, split into what changes the shape and what only drags the
/// texture along the surface. In units of length.
struct Displacement {
    Point tangential = Point::Zero();
    /// Along the normal, negative against it.
    double normal = 0.0;
    /// False for a vertex that has no normal in either state, or turned over: both parts are 0 then.
    bool defined = false;
};

/// Splits the displacement V′ − V of a vertex along the direction n + n′, the sum of the unit normals of both states.
/// The normal of one state alone would count the sagitta of every finite move along a curved surface as a move out of
/// it; with n + n′ any rotation of a sphere about its centre is tangential, and neither state is preferred.
/// @param normal_before, normal_after n and n′, of length 1, or 0 where there is none: then only the other counts.
Displacement split_displacement(const Point& displacement, const Point& normal_before, const Point& normal_after);

/// The parts of the displacements of all vertices.
struct DisplacementField {
    /// #V: length of the tangential part, and signed normal part, in units of length; not a number where the split is
    /// not defined.
    std::vector<double> tangential;
    std::vector<double> normal;
};

/// Displacements from `before` to `after`, #V by 3 each, of the vertices of `mesh`.
/// @throws InputError if the numbers of vertices differ.
DisplacementField displacement_field(const PolygonMesh& mesh, const Points& before, const Points& after);

/// Both parts over all vertices where they are defined, including vertices that stay in place.
struct DisplacementStatistics {
    LengthStatistics tangential;
    LengthStatistics normal;
};

DisplacementStatistics displacement_statistics(const DisplacementField& field);

}  // namespace seamflow
