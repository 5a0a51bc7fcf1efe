#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/connected_components.h"
#include "partition/metrics/vertex_normals.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Limits what the components of a surface lose (see ComponentLimits): the displacements of one that would lose more
/// are multiplied by the largest factor at which it does not. A blend of the surfaces before and after is that of a
/// filter that removes less of everything.
class LimitedComponents {
  public:
    /// Measures the surface as it is. The mesh and topology must outlive the object.
    /// @param topology with twins, which are not needed later.
    LimitedComponents(const PolygonMesh& mesh, const Topology& topology, const ComponentLimits& limits);

    /// Moves the vertices of components that have lost too much back, along a straight line to where they were at
    /// first.
    /// @param positions #V by 3.
    void apply(Points& positions);

    /// On the last result; nothing where no component had lost too much.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// Of volume, beyond the limit: in length³, and as a fraction of it. 0: within.
    struct Loss {
        double volume = 0.0;
        double fraction = 0.0;
    };

    void limit_slides(Points& positions) const;
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
    Points first_;
    /// Per component: the factor by which displacements were multiplied in the last result.
    std::vector<double> factors_;
    /// Per component: what it would have lost in the last result.
    std::vector<Loss> losses_;
};

}  // namespace seamflow
