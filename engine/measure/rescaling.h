#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/surface_components.h"
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

/// A map of a surface: a similarity for each of its components.
struct SimilarityOfComponents {
    /// #V: the component of each vertex; -1 where there are no faces.
    std::span<const Index> component_of;
    /// One for each component; empty: nothing moves.
    std::vector<Similarity> maps;

    template <class Position>
    [[nodiscard]] Point operator()(Index v, const Position& x) const
    {
        return maps.empty() || component_of[v] < 0 ? Point(x) : maps[component_of[v]](x);
    }
};

/// Brings each component of a surface (see SurfaceComponents) back to the area or volume that it began with, and to the
/// centroid of its area (see Rescale): parts neither move apart nor make up for each other. A component without a
/// volume, or of which too little is left, stays as the flow leaves it, unless that holds for all. The
/// area of a face is the length of its vector area; volume is measured under the triangles that join every face's edges
/// to the mean of its corners.
class Rescaling {
  public:
    /// Measures the surface as it is. The mesh and topology must outlive the object.
    /// @throws InputError if a vertex with faces is fixed; for the volume if the surface has a boundary, faces that are
    ///         not oriented alike (naming an edge), or no volume in any component.
    Rescaling(const PolygonMesh& mesh, const Topology& topology, Rescale kind);

    /// Scales positions of the flow, #V by 3; vertices without faces stay. Does nothing without Rescale.
    /// @returns the map applied to the other vertices, which refers to this.
    /// @throws ComputationError if too little is left of every component.
    SimilarityOfComponents apply(Points& positions);

    /// On components that the last call left as they were; nothing if there were none.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// A component as a whole.
    struct Extent {
        double area;
        /// Area or volume.
        double size;
        Point centroid;
    };
    [[nodiscard]] Extent measure(Index component, const Points& positions) const;
    [[nodiscard]] bool has_size(const Extent& extent) const;
    [[nodiscard]] Similarity back(const Extent& first, const Extent& now) const;

    const PolygonMesh* mesh_;
    Rescale kind_;
    SurfaceComponents components_;
    /// The lowest vertex of each component.
    std::vector<Index> origins_;
    /// The extent of each component before the first step.
    std::vector<Extent> first_;
    /// How many components the last call left as they were.
    Index n_left_ = 0;
};

}  // namespace seamflow
