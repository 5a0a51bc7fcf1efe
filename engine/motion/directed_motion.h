#pragma once

#include "engine/options/motion_options.h"
#include "partition/executor.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Lets vertices move only along the lines of a MotionDirection, so that the surface still becomes the one to which the
/// whole motion leads: motion within that surface is left out.
class DirectedMotion {
  public:
    /// @param mesh, topology must outlive this; the topology has the corners at all vertices.
    DirectedMotion(const PolygonMesh& mesh, const Topology& topology, const MotionDirection& direction);

    /// Whether all lines are parallel, and the same in every step.
    [[nodiscard]] bool is_parallel() const { return !follows_normals_; }

    /// V' = V + ((V̂ - V)·n) n, with n the normal of V̂ at each vertex, of length 1; or V' = V + s d, the point on a
    /// line of direction d where the line meets the plane through V̂ with the normal n. Where the surface is steeper
    /// than 45°, it is the nearest of the points where the line meets this plane and the planes of the faces of V̂, so
    /// that walls do not spread. So a plane stays a plane, and a height field a height field, whatever their slope. The
    /// motion is reduced on steep regions that turn over nearby, as seen along d, because lines may miss the moved
    /// surface there. At the boundary, planes steeper than 45° are not followed beyond the edges at V̂, and a vertex
    /// does not move if its line passes V̂ at a distance longer than these edges as seen along d: the line misses the
    /// moved surface. Without a normal, at junctions, s is that of the motion. Coordinates to which nothing is added do
    /// not change, bit for bit.
    /// @param before #V by 3: V. @param after in: V̂; out: V'.
    void project(const Points& before, Points& after, const Executor& exec) const;

    /// Removes the components that rounding has added across parallel lines: V' = V + ((V̂ - V)·d) d.
    void straighten(const Points& before, Points& after, const Executor& exec) const;

  private:
    /// Whether the faces at a vertex are seen from both sides along the lines, or one of them edgewise. Vertices at
    /// junctions, which have no normal, count as such.
    [[nodiscard]] bool is_on_silhouette(Index v, const Points& positions) const;

    /// The shortest motion along the line to the planes through V̂ of the surface at a vertex, and of the faces there;
    /// 0 at the boundary if all of these lead further from V̂ than its longest edge, and than the distance of the line.
    [[nodiscard]] double least_way(Index v, const Point& way, const Points& moved) const;

    /// The length of the longest edge at a vertex, mapped by `seen`.
    /// @param seen maps the vector of an edge to another vector.
    template <class Seen>
    [[nodiscard]] double longest_edge(Index v, const Points& positions, Seen&& seen) const;

    /// Whether the line of a vertex of the boundary passes the moved vertex at a distance longer than the edges of the
    /// latter, as seen along the lines.
    [[nodiscard]] bool misses_rim(Index v, const Point& way, const Points& moved) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    Point direction_;
    bool follows_normals_;
    VertexNormals normals_;
};

}  // namespace seamflow
