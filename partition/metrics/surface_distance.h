#pragma once

#include <memory>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/length_statistics.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Squared distance of the origin from the triangle abc, in length². The triangle may be arbitrarily thin, a segment or
/// a point. Never too small except by rounding: it is always taken to a point of the triangle. Pass the corners
/// relative to the point of interest, so that no offset costs precision.
double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c);

/// Distances from points to the surface of a mesh, whose polygons are triangulated (see triangulation.h); triangles
/// without area count as the segments or points that they are. A tree of boxes makes them fast: the time for a point
/// grows with the logarithm of the number of faces, also where many faces are about as far away, as from the middle of
/// a sphere, if points are close together there.
class SurfaceDistance {
  public:
    /// Builds the tree. The mesh is not needed afterwards.
    /// @throws InputError for a mesh without faces.
    explicit SurfaceDistance(const PolygonMesh& surface, const Executor& exec = run_serially);
    ~SurfaceDistance();
    SurfaceDistance(SurfaceDistance&&) noexcept;
    SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

    /// The distance of every point from the closest point of the surface, in units of length; one entry per row. Exact
    /// to rounding, wherever the origin is: a point and a triangle are taken relative to each other. The same bits for
    /// every executor. Thread-safe.
    /// @param points finite, one a row.
    [[nodiscard]] std::vector<double> operator()(const Points& points, const Executor& exec = run_serially) const;

  private:
    class Tree;
    std::unique_ptr<const Tree> tree_;
};

/// H_mean, H_RMS and H_max of the paper (section Evaluation), in units of length: the distances of the vertices of
/// `from` to the closest points of the surface of `to`. Vertices of `from` without faces are not counted: a mesh has
/// distance 0 from itself.
/// @throws InputError if one of the meshes has no faces.
LengthStatistics surface_distance(const PolygonMesh& from, const PolygonMesh& to, const Executor& exec = run_serially);

/// The larger of each pair of numbers. Applied to H in both directions, it is symmetric in the two meshes.
LengthStatistics larger_of(const LengthStatistics& a, const LengthStatistics& b);

}  // namespace seamflow
