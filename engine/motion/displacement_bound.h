#pragma once

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Keeps every vertex within a distance r of its initial position: the surface is replaced by the nearest one that
/// satisfies this, so that vertices stop at the boundaries of their spheres and all others follow smoothly.
///
/// The distance of two surfaces is that of the metric of a diffusion step with uniform weights: the correction U
/// minimises tr Uᵀ (D + t K) U under |V - V⁰ + U| ≤ r at each vertex, with K the Laplacian of the graph with weights of
/// one, and D its diagonal; vertices that have not moved have no correction. A fixed number of accelerated projected
/// gradient steps (Nesterov, Lectures on Convex Optimization, 2018, 2.2) brings U within a ten-thousandth of the
/// minimum; each step projects every vertex into the ball of radius r around V⁰, so that the bound is exact.
class DisplacementBound {
  public:
    /// Takes the positions of the mesh as the initial ones.
    /// @param bound r, above 0, in units of length.
    DisplacementBound(const PolygonMesh& mesh, const Topology& topology, double bound);

    /// Applies the bound.
    /// @param positions #V by 3, in: of the flow; out: within the bound.
    void apply(Points& positions) const;

  private:
    /// The displacement, shortened to length r if it is longer.
    [[nodiscard]] Point bounded(const Point& displacement) const;

    double bound_;
    /// #V by 3: the initial positions.
    Points initial_;
    /// Per vertex: the vertices that share an edge with it.
    IndexLists neighbours_;
};

}  // namespace seamflow
