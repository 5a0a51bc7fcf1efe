#pragma once

#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Lets vertices move only along the lines of a MotionDirection, and the surface follow the one that the whole motion
/// gives: what slides along that surface moves nothing.
class DirectedMotion {
  public:
    /// @param mesh, topology must outlive this, with the corners at all vertices.
    DirectedMotion(const PolygonMesh& mesh, const Topology& topology, const MotionDirection& direction);

    /// Whether all lines are parallel, and the same for every step.
    [[nodiscard]] bool is_parallel() const { return !follows_normals_; }

    /// V' = V + ((V̂ - V)·n) n, with n the normal of V̂ at each vertex, of length 1; or V' = V + s d, the point on a line
    /// of direction d where it meets the plane through V̂ with the normal n, or where the surface is steeper than 45°
    /// the nearest of this plane and those of the faces of V̂, so that walls do not spread. So a plane stays a plane,
    /// and a height field a height field, whatever their slope. Less of the way is gone on steep parts that turn over
    /// nearby, as seen along d: there, lines may miss the moved surface. At the boundary, planes steeper than 45°
    /// are not followed beyond the edges at V̂, and a vertex stays if its line passes V̂ further away than these are long
    /// as seen along d: it misses the moved surface. Without a normal, at junctions, s is that of the motion.
    /// Coordinates to which nothing is added stay bit for bit.
    /// @param before #V by 3: V. @param after in: V̂; out: V'.
    void project(const Points& before, Points& after, const Executor& exec) const;

    /// Takes back what rounding has added beside parallel lines: V' = V + ((V̂ - V)·d) d.
    void straighten(const Points& before, Points& after, const Executor& exec) const;

  private:
    /// Whether the faces at a vertex are seen from both sides along the lines, or one of them edgewise.
    [[nodiscard]] bool is_on_silhouette(Index v, const Points& positions) const;

    /// The shortest way along the line to the planes through V̂ of the surface at a vertex, and of the faces there; 0 at
    /// the boundary if all would lead further from V̂ than its edges are long.
    [[nodiscard]] double least_way(Index v, const Point& way, const Points& moved) const;

    /// The length of the longest edge at a vertex, as it is seen.
    /// @param seen maps the vector of an edge to another one.
    template <class Seen>
    [[nodiscard]] double longest_edge(Index v, const Points& positions, Seen&& seen) const;

    /// Whether the line of a vertex of the boundary passes the moved one further away than its edges are long, as seen
    /// along the lines.
    [[nodiscard]] bool misses_rim(Index v, const Point& way, const Points& moved) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    Point direction_;
    bool follows_normals_;
    VertexNormals normals_;
};

}  // namespace seamflow
