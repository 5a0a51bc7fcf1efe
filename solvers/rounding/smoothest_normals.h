#pragma once

#include <cstdint>
#include <vector>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"
#include "solvers/rounding/coordinate_bounds.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/normals_in_boxes.h"
#include "solvers/rounding/surface_parts.h"

namespace seamflow {

/// Smooths the normals of each part of a surface in two ways, over all neighbours and over those on one side of edges
/// (see NormalsInBoxes), and takes the way in which it bends less.
class SmoothestNormals {
  public:
    /// @param mesh its vertices are not used. @param volumes those that are kept. @param boxes, kind: those of the
    /// bounds. All but the kind must outlive the object.
    SmoothestNormals(const PolygonMesh& mesh, const Topology& topology, const KeptVolumes& volumes, const Boxes& boxes,
                     CoordinateBounds::Kind kind, const Executor& exec);

    /// @param positions #V by 3: in the boxes; replaced.
    void smooth(Points& positions);

    /// Takes other positions for the parts that are not thin: parts that keep little of the bending that they have in
    /// the middles of their boxes.
    /// @param from, positions #V by 3.
    void take_unless_thin(const Points& from, Points& positions) const;

  private:
    /// Per part: 1 if it keeps so much of its bending that it is thin.
    [[nodiscard]] std::vector<std::uint8_t> thin_parts(const std::vector<double>& bending) const;

    /// Takes the positions of the vertices of some parts.
    void take(const std::vector<std::uint8_t>& taken, const Points& from, Points& positions) const;

    CoordinateBounds::Kind kind_;
    const Executor& exec_;
    Components components_;
    SurfaceParts parts_;
    NormalsInBoxes normals_;
    /// Per part, in the middles of the boxes; empty where kinds have no thin parts.
    std::vector<double> before_;
};

}  // namespace seamflow
