#pragma once

#include <span>
#include <vector>

#include "partition/metrics/vertex_normals.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/rim_curves.h"

namespace seamflow {

/// Removes noise and stairs from the boundary of a surface, within the surface. Vertices move at right angles to a
/// smooth curve that keeps corners (see smooth_curve), onto that curve, so that outlines do not shrink and straight
/// outlines stay straight. Curves that look as if they were made as they are do not change.
class RimFilter {
  public:
    /// @param mesh, topology must outlive the filter; the twins of the topology are not needed later.
    RimFilter(const PolygonMesh& mesh, const Topology& topology);

    /// The motions of rims that have noise, and of the surface around them (see spread_into_band); 0 elsewhere.
    /// @param normals #F by 3: of the surface, of length 1 or 0.
    /// @param shares #V: where the surface has noise, from 0 to 1.
    /// @param positions #V by 3.
    /// @returns #V by 3.
    [[nodiscard]] Points motions(const PolygonMesh& mesh, const Topology& topology, const Points& normals,
                                 std::span<const double> shares, const Points& positions) const;

  private:
    std::vector<RimCurve> curves_;
    VertexNormals vertex_normals_;
};

}  // namespace seamflow
