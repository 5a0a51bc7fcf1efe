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
/// small compared to √dt nearly to a point, its centroid, which does not move. But its masses are lost to rounding
/// beside dt K, and with them the position of that point. Such a component is scaled up about its centroid before the
/// step (its enlargement), and the result is scaled back: about 1 / (dt λ) is left of its shape, where the eigenvalues
/// λ of M⁻¹ K scale with the inverse square of lengths. A component that is too small for the digits of its coordinates
/// is treated as a point, and does not move.
class VanishingComponents {
  public:
    /// @param mesh in its state before the first step, to which an attachment pulls. The mesh, the topology, and the
    /// data to which the equation refers must outlive this.
    /// @param is_implicit whether steps are backward Euler steps: others do not shrink components to points.
    VanishingComponents(const PolygonMesh& mesh, const Topology& topology, const StepEquation& equation,
                        bool is_implicit);

    /// Takes one step. @throws as Stepper::step.
    void step(Stepper& stepper, const Points& before);

    /// To be called after vertices were fixed or released: components without fixed vertices are found anew.
    void look_again() { free_.reset(); }
    /// To be called when weights of the attachment change. @param weights one for each vertex, in 1/length².
    void attach(std::span<const Index> vertices, std::span<const double> weights);
    /// To be called when vertices of V⁰ move. @param to #vertices by 3.
    void set_reference_vertices(std::span<const Index> vertices, const Points& to);

    /// A sentence on small components; empty if there were none.
    [[nodiscard]] std::optional<Remark> remark() const;

  private:
    /// The enlargement of a component for a step: the map from the component to the enlarged copy in its place, for
    /// which the step is computed.
    struct Enlargement {
        /// The mean of its vertices, the fixed point of the map.
        Point centre;
        /// The factor of lengths; 0: the component is a point, and its copy is a sphere.
        double scale = 0.0;
        /// The factor by which the shape in the result of the step is multiplied: at most 1 / scale, because the step
        /// shrinks the component itself more than its enlarged copy.
        double rest = 0.0;
    };
    [[nodiscard]] IndexLists free_components() const;
    [[nodiscard]] IndexLists find_small(const Points& positions, double extent);
    [[nodiscard]] Enlargement enlarge(std::span<const Index> vertices, Points& positions) const;
    [[nodiscard]] double weight(Index v) const;
    void bring_back(std::span<const Index> vertices, const Enlargement& enlargement, const Points& before,
                    Points& positions) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    StepEquation equation_;
    /// Whether the K of steps depends on initial lengths, not on present ones.
    bool has_kept_lengths_ = false;
    /// #V by 3: the initial positions; empty if neither K is kept nor an attachment exists.
    Points initial_ = Points(0, 3);
    /// #V: the weights of the attachment, in 1/length²; empty if all vertices have the same.
    std::vector<double> weights_;
    /// The result of free_components, once it has been asked for; look_again() empties it.
    std::optional<IndexLists> free_;
    /// The diagonal below which components are small; 0: no component is treated as small.
    double extent_ = 0.0;
    /// The largest number of small components in a step.
    Index most_ = 0;
};

}  // namespace seamflow
