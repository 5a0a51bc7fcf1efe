#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "partition/connected_components.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes steps of surfaces whose components differ much in size. A backward Euler step shrinks a component that is
/// small compared to √dt to about a point, and next to dt K its masses are lost to rounding, and its place with them.
/// A component whose bounding box has a diagonal below √(dt / 10⁵), which a step would leave a ten-billionth part of,
/// is brought to its centroid instead, and stays there.
class VanishingComponents {
  public:
    /// @param mesh the first surface; it, topology and options must outlive this.
    VanishingComponents(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options);

    /// One step. @throws as Stepper::step.
    void step(Stepper& stepper, const Points& before);

    /// A sentence on components that were so small; empty if there were none.
    [[nodiscard]] std::string remark() const;

  private:
    [[nodiscard]] bool has_small_face(const Points& positions) const;
    [[nodiscard]] bool is_small(const Points& positions, std::span<const Index> vertices) const;
    void find_components();
    [[nodiscard]] bool is_free(std::span<const Index> vertices) const;
    std::vector<Index> find_small(const Points& positions);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    const FlowOptions* options_;
    /// Vertices connected by faces. Found when they are needed.
    Components components_;
    /// Below it components are small; 0: no step needs this.
    double extent_ = 0.0;
    /// Per component: the extent with which a step can be taken; empty: extent_.
    std::vector<double> pose_;
    /// How many there were at most.
    std::size_t most_ = 0;
};

}  // namespace seamflow
