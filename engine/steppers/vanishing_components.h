#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes steps of surfaces whose components differ much in size. A backward Euler step shrinks a component that is
/// small compared to √dt to about a point: its centroid, which stays. But next to dt K its masses are then lost to
/// rounding, and its place with them. Such a component is scaled up about its centroid before the step, and the result
/// is scaled back: of everything except the centroid about 1 / (dt λ) is left, where λ are the eigenvalues of M⁻¹ K,
/// which go with the square of lengths. A component that its coordinates no longer resolve is a point, and stays.
class VanishingComponents {
  public:
    /// @param mesh as it is before the first step: an attachment attaches to that. It, the topology and the options
    /// must outlive this.
    VanishingComponents(const PolygonMesh& mesh, const Topology& topology, const FlowOptions& options);

    /// One step. @throws as Stepper::step.
    void step(Stepper& stepper, const Points& before);

    /// Of changes between steps: which vertices are held, weights of the attachment, and first positions.
    void look_again() { free_.reset(); }
    void attach(std::span<const Index> vertices, std::span<const double> weights);
    void set_reference_vertices(std::span<const Index> vertices, const Points& to);

    /// On components that were so small; nothing if there were none.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// How a component is brought to where the step is taken.
    struct Pose {
        /// The mean of its vertices, which stays where it is.
        Point centre;
        /// 0: the component is a point.
        double scale = 0.0;
        /// Factor for the shape that the step leaves there.
        double rest = 0.0;
    };
    [[nodiscard]] IndexLists free_components() const;
    [[nodiscard]] IndexLists find_small(const Points& positions, double extent);
    [[nodiscard]] Pose pose(std::span<const Index> vertices, Points& positions) const;
    [[nodiscard]] double weight(Index v) const;
    void bring_back(std::span<const Index> vertices, const Pose& pose, const Points& before, Points& positions) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const FlowOptions& options_;
    bool is_attached_ = false;
    /// Whether steps have a K that depends on lengths of the first surface, not on present ones.
    bool has_kept_lengths_ = false;
    /// The first positions, empty where neither holds; and the weights of an attachment that has one for each vertex.
    Points first_ = Points(0, 3);
    std::vector<double> weights_;
    /// See free_components, once that is asked for.
    std::optional<IndexLists> free_;
    /// Below it components are small; 0: no step needs this.
    double extent_ = 0.0;
    /// How many there were at most.
    Index most_ = 0;
};

}  // namespace seamflow
