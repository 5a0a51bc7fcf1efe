#pragma once

#include "engine/options/motion_options.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The same bound for vertices that move along `direction`: of lengths along the axes, the distance at which the line
/// of a vertex leaves its box.
/// @param bound in units of length.
MotionBound bound_along(const MotionDirection& direction, const MotionBound& bound);

/// Keeps every vertex within a distance r of its initial position, or in a box around it: the surface is replaced by
/// the nearest one that satisfies this, so that vertices stop at the boundaries of their spheres or boxes and all
/// others follow smoothly.
///
/// The distance of two surfaces is that of the metric of a diffusion step with uniform weights: the correction U
/// minimises tr Uᵀ (D + t K) U under |V - V⁰ + U| ≤ r at each vertex, with K the Laplacian of the graph with weights of
/// one, and D its diagonal; vertices that have not moved have no correction. A fixed number of accelerated projected
/// gradient steps (Nesterov, Lectures on Convex Optimization, 2018, 2.2) brings U within a ten-thousandth of the
/// minimum; each step projects every vertex into the ball of radius r around V⁰, or into the box, so that the bound is
/// exact.
class DisplacementBound {
  public:
    /// Takes the positions of the mesh as the initial ones.
    /// @param bound in units of length; its lengths are above 0.
    DisplacementBound(const PolygonMesh& mesh, const Topology& topology, const MotionBound& bound);

    /// Applies the bound.
    /// @param positions #V by 3, in: of the flow; out: within the bound.
    void apply(Points& positions) const;

  private:
    [[nodiscard]] bool is_beyond(const Point& displacement) const;

    /// The nearest displacement that the bound allows.
    [[nodiscard]] Point bounded(const Point& displacement) const;

    /// Half the sides of the boxes, or r three times.
    Point lengths_;
    bool along_axes_;
    /// #V by 3: the initial positions.
    Points initial_;
    /// Per vertex: the vertices that share an edge with it.
    IndexLists neighbours_;
};

}  // namespace seamflow
