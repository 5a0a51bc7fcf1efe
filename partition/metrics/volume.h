#pragma once

#include <span>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The volume of the cone from an origin to a face, in length³, negative if the face is turned towards the origin. A
/// polygon that is not planar is a fan around the mean of its corners.
inline double cone_volume(std::span<const Index> corners, const Points& positions, const Point& origin)
{
    Point mean = Point::Zero();
    for (const Index v : corners)
        mean += positions.row(v) - origin;
    return vector_area(corners, positions).dot(mean) / (3.0 * static_cast<double>(corners.size()));
}

/// The volume between an origin and the faces, in length³: the sum of the cones from the origin to the faces, negative
/// for faces turned towards it. Polygons that are not planar are fans around the mean of their corners. If a surface
/// encloses a volume, the result is the same for any origin.
/// @param positions #V by 3, not necessarily those of the mesh.
double volume_of_cones(const PolygonMesh& mesh, const Points& positions, const Point& origin, const Executor& exec);

/// Whether the faces run along each edge as often in one direction as in the other; otherwise the surface is open, or
/// its faces are not oriented alike. False without faces.
bool encloses_volume(const PolygonMesh& mesh, const Executor& exec);

/// Whether these faces of the mesh, without the others, enclose a volume: run along each edge as often in one direction
/// as in the other. False without faces.
bool encloses_volume(const PolygonMesh& mesh, std::span<const Index> faces, const Executor& exec = run_serially);

}  // namespace seamflow
