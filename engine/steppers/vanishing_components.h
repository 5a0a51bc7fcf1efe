#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/steppers/stepper.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes steps of surfaces whose components differ much in size. A backward Euler step shrinks a component that is
/// small compared to √dt nearly to a point, its centroid by M. But its masses are lost to rounding beside dt K, and
/// with them the position of that point. A component whose diagonal is below √(dt / 10⁵) therefore goes to its
/// centroid, and all its vertices stay there together.
class VanishingComponents {
  public:
    /// @param mesh in its state before the first step, to which an attachment pulls. The mesh, the topology, and the
    /// data to which the equation refers must outlive this.
    /// @param is_implicit whether steps are backward Euler steps: others do not shrink components to points.
    VanishingComponents(const PolygonMesh& mesh, const Topology& topology, const StepEquation& equation,
                        bool is_implicit);

    /// Takes one step. @throws as Stepper::step.
    void step(Stepper& stepper, const Points& before);

    /// To be called when weights of the attachment change. @param weights one for each vertex, in 1/length².
    void attach(std::span<const Index> vertices, std::span<const double> weights);
    /// To be called when vertices of V⁰ move. @param to #vertices by 3.
    void set_reference_vertices(std::span<const Index> vertices, const Points& to);

    /// A sentence on small components; empty if there were none.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    [[nodiscard]] bool is_small(Index component, const Points& positions) const;
    std::vector<Index> find_small(const Points& positions);
    [[nodiscard]] Eigen::ArrayXd masses(Index component, const Points& positions) const;
    [[nodiscard]] Point centroid(Index component, const Points& positions) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    StepEquation equation_;
    /// #V by 3: V⁰; empty without an attachment.
    Points initial_ = Points(0, 3);
    /// #V: the weights of the attachment, in 1/length², to which the equation refers; empty until one changes.
    std::vector<double> weights_;
    /// The faces and the vertices of all components, ascending in each; empty until they are needed.
    IndexLists faces_;
    IndexLists vertices_;
    /// The diagonal below which components are small; 0: no component is treated as small.
    double extent_ = 0.0;
    /// The largest number of small components in a step.
    Index most_ = 0;
};

}  // namespace seamflow
