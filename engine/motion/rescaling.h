#pragma once

#include <optional>
#include <vector>

#include "engine/motion/similarity.h"
#include "engine/options/motion_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/surface_components.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Brings each component of a surface (see SurfaceComponents) back to the area or volume and to the centroid of area
/// that it began with (see Rescale): components neither move apart nor compensate for each other. A component without
/// an area or volume above rounding, or of which too little is left, is not scaled; if that holds for all components,
/// it is an error. The area of a face is the length of its vector area; volume is measured under the triangles that
/// join every face's edges to the mean of its corners.
class Rescaling {
  public:
    /// Measures the surface as it is. The mesh and topology must outlive the object.
    /// @throws InputError if a vertex with faces is fixed; for the volume if the surface has a boundary, faces that are
    ///         not oriented alike (naming an edge); if no component has an area or volume above rounding.
    Rescaling(const PolygonMesh& mesh, const Topology& topology, Rescale kind);

    /// Scales positions of the flow; vertices without faces keep their positions. Does nothing without Rescale.
    /// @param positions #V by 3.
    /// @returns the map applied to the other vertices, which refers to this object.
    /// @throws ComputationError if too little is left of every component.
    SimilarityOfComponents apply(Points& positions);

    /// A sentence on the components that the last call did not scale; empty if it scaled all.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// The size and the centroid of a component.
    struct Extent {
        /// In length².
        double area;
        /// The area again, or the volume in length³: what Rescale keeps.
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
    std::vector<Extent> initial_;
    /// The number of components that the last call did not scale.
    Index n_left_ = 0;
};

}  // namespace seamflow
