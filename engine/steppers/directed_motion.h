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
    /// of direction d where it meets the plane through V̂ with the normal n. So a plane stays a plane, and other
    /// surfaces are followed, as far as lines meet them at 45° or more; less of the way is gone elsewhere. Coordinates
    /// to which nothing is added stay bit for bit.
    /// @param before #V by 3: V. @param after in: V̂; out: V'.
    void project(const Points& before, Points& after, const Executor& exec) const;

    /// Takes back what rounding has added beside parallel lines: V' = V + ((V̂ - V)·d) d.
    void straighten(const Points& before, Points& after, const Executor& exec) const;

  private:
    Point direction_;
    bool follows_normals_;
    VertexNormals normals_;
};

}  // namespace seamflow
