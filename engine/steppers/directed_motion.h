#pragma once

#include <optional>

#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Leaves of displacements only what lies along the lines of a MotionDirection.
class DirectedMotion {
  public:
    /// @param mesh, topology must outlive this, with the corners at its vertices where lines are normals.
    DirectedMotion(const PolygonMesh& mesh, const Topology& topology, const MotionDirection& direction);

    /// Whether all lines are parallel, and the same for every step.
    [[nodiscard]] bool is_parallel() const { return !normals_; }

    /// V' = V + ((V̂ - V)·d) d, with d of length 1 at each vertex, that of V where it is the normal. Coordinates to
    /// which nothing is added stay bit for bit.
    /// @param before #V by 3: V. @param after in: V̂; out: V'.
    void project(const Points& before, Points& after, const Executor& exec) const;

  private:
    Point direction_;
    std::optional<VertexNormals> normals_;
};

}  // namespace seamflow
