#pragma once

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// A map of space that scales and translates: x goes to `to` + `scale` (x - `from`). Differences of positions and
/// lengths are multiplied by `scale`.
struct Similarity {
    Point from = Point::Zero();
    double scale = 1.0;
    Point to = Point::Zero();

    template <class Position>
    [[nodiscard]] Point operator()(const Position& x) const
    {
        return to + scale * (x - from);
    }
};

/// Brings a surface back to the area or volume that it began with, and to the centroid of its area (see Rescale). The
/// area of a face is the length of its vector area; volume is measured under the triangles that join every face's edges
/// to the mean of its corners.
class Rescaling {
  public:
    /// Measures the surface as it is. The mesh and topology must outlive the object.
    /// @throws InputError if a vertex with faces is fixed; for the volume if the surface has a boundary, faces that are
    ///         not oriented alike (naming an edge), or no volume.
    Rescaling(const PolygonMesh& mesh, const Topology& topology, Rescale kind);

    /// Scales positions of the flow, #V by 3; vertices without faces stay. Does nothing without Rescale.
    /// @returns the map applied to the other vertices.
    /// @throws ComputationError if too little of the surface is left.
    Similarity apply(Points& positions) const;

  private:
    /// A surface as a whole.
    struct Extent {
        double area;
        /// Area or volume.
        double size;
        Point centroid;
    };
    [[nodiscard]] Extent measure(const Points& positions) const;

    const PolygonMesh* mesh_;
    const Topology* topology_;
    Rescale kind_;
    Extent first_{};
};

}  // namespace seamflow
