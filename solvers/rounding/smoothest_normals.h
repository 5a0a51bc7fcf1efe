#pragma once

#include <cstdint>
#include <functional>
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

    /// Smooths some parts once more: those that keep so little of the bending that they
    /// have in the middles of their boxes that they are not thin, and of whose vertices many are among the given ones.
    /// @param vertices ascending. @param change is called for the new positions before they are taken.
    void smooth_again(const std::vector<Index>& vertices, const std::function<void(Points&)>& change,
                      Points& positions);

  private:
    /// Per part: 1 if it keeps at least these fractions of its bending, of voxels and of marching cubes.
    [[nodiscard]] std::vector<std::uint8_t> parts_that_keep(double of_voxels, double of_marching_cubes) const;

    /// Takes the positions of the vertices of some parts.
    void take(const std::vector<std::uint8_t>& taken, const Points& from, Points& positions) const;

    CoordinateBounds::Kind kind_;
    const Executor& exec_;
    Components components_;
    SurfaceParts parts_;
    NormalsInBoxes normals_;
    const Boxes& boxes_;
    /// The bending of each part in the middles of the boxes, empty where kinds have no thin parts; and when it is
    /// smooth over all neighbours.
    std::vector<double> before_;
    std::vector<double> smooth_;
};

}  // namespace seamflow
