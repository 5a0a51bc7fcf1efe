#pragma once

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Keeps every vertex within a distance r of where it was: the surface is replaced by the nearest one that satisfies
/// this, so that vertices are held on the boundaries of their spheres and all others follow smoothly.
///
/// Nearest is meant in the metric of a diffusion step with uniform weights: the correction U minimises
/// tr Uᵀ (D + t K) U under |V - V⁰ + U| ≤ r at each vertex, K the Laplacian of the graph with weights of one, D its
/// diagonal; vertices that have not moved have none. A fixed number of accelerated projected gradient steps (Nesterov,
/// Lectures on Convex Optimization, 2018, 2.2) brings U within a ten-thousandth of the minimum; each projects every
/// vertex onto its sphere, so that the bound holds whatever is left.
class DisplacementBound {
  public:
    /// Takes the positions of the mesh as those to stay near.
    /// @param bound r, above 0, in units of length.
    DisplacementBound(const PolygonMesh& mesh, const Topology& topology, double bound);

    /// @param positions #V by 3, as a flow has them; receives those within the bound.
    void apply(Points& positions) const;

  private:
    [[nodiscard]] Point bounded(const Point& displacement) const;

    double bound_;
    /// #V by 3.
    Points first_;
    IndexLists neighbours_;
};

}  // namespace seamflow
