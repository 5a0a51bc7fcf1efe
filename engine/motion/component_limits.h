#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/options/motion_options.h"
#include "partition/connected_components.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Limits the changes of the components of a surface (see ComponentLimits): if a component would change too much, its
/// displacements are multiplied by a factor below 1: the largest that keeps the limits, or 0 if that is below 0.1. Such
/// a blend of the surfaces before and after is like the result of a weaker filter. The smallest of their factors counts
/// for a vertex of several components.
class LimitedComponents {
  public:
    /// Measures the surface as it is. The mesh and topology must outlive the object.
    /// @param topology with twins, which are not needed later.
    LimitedComponents(const PolygonMesh& mesh, const Topology& topology, const ComponentLimits& limits);

    /// Moves the vertices of components that have changed too much back, on the straight lines to their initial
    /// positions.
    /// @param positions #V by 3. @param exempt #F: 1 in components that are not limited; empty: there are none.
    void apply(Points& positions, std::span<const std::uint8_t> exempt = {});

    /// A sentence about the last result; empty if no component had changed too much.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// A change of volume beyond the limit: in length³, and as a fraction of the volume. 0: within the limit.
    struct Loss {
        double volume = 0.0;
        double fraction = 0.0;
    };

    [[nodiscard]] bool is_exempt(Index component, std::span<const std::uint8_t> exempt) const;
    void limit_slides(Points& positions, std::span<const std::uint8_t> exempt) const;
    [[nodiscard]] double volume_of(Index component, const Points& positions, double factor) const;
    [[nodiscard]] double factor_by_volume(Index component, const Points& positions);
    [[nodiscard]] double factor_by_move(Index component, const Points& positions) const;
    [[nodiscard]] double factor_of(Index component, const Points& positions);
    [[nodiscard]] std::string largest_loss() const;

    const PolygonMesh* mesh_;
    ComponentLimits limits_;
    VertexNormals normals_;
    Components components_;
    /// Per component: its vertices, ascending; whether it encloses a volume.
    IndexLists vertices_;
    std::vector<std::uint8_t> is_closed_;
    /// #V by 3: the positions before the first step.
    Points initial_;
    /// Per component: the factor that its displacements were multiplied by in the last result.
    std::vector<double> factors_;
    /// Per component: the change of its volume that the last result would have without a factor.
    std::vector<Loss> losses_;
};

}  // namespace seamflow
