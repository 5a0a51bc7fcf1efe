#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Small components of a mesh, connected by shared vertices, that nothing holds.
struct SmallComponents {
    /// Per component, its rows in the table of their vertices: ascending by vertex.
    IndexLists rows;
    /// Per row, the vertex.
    std::vector<Index> vertices;
    /// Makes the table of vertex data, given as #V by 3: #rows by 3.
    std::function<Points(const Points& of_vertices)> table;
};

/// Finds those whose bounding boxes have diagonals of less than `extent`.
using FindSmallComponents = std::function<SmallComponents(const Points& positions, double extent)>;

/// Makes such a function.
/// @param mesh, topology, strength must outlive it; the last is MotionOptions::strength.
FindSmallComponents find_small_components(const PolygonMesh& mesh, const Topology& topology,
                                          std::span<const double> strength = {});

/// Takes steps of surfaces whose components differ much in size. A backward Euler step shrinks a component that is
/// small compared to √dt to about a point: its centroid, which stays. But next to dt K its masses are then lost to
/// rounding, and its place with them. Such a component is scaled up about its centroid before the step, and the result
/// is scaled back: of everything except the centroid about 1 / (dt λ) is left, where λ are the eigenvalues of M⁻¹ K,
/// which go with the square of lengths. A component that its coordinates no longer resolve is a point, and stays.
class VanishingComponents {
  public:
    /// @param first #V by 3: what an attachment attaches to.
    VanishingComponents(const FlowOptions& options, const Points& first, FindSmallComponents find);

    /// One step. @throws as Stepper::step.
    void step(Stepper& stepper, const Points& before);

    /// Of changes between steps: which vertices are held, weights of the attachment, and first positions.
    void look_again(FindSmallComponents find) { find_ = std::move(find); }
    void attach(std::span<const Index> vertices, std::span<const double> weights);
    void set_reference_vertices(std::span<const Index> vertices, const Points& to);

    /// A sentence on components that were so small; empty if there were none.
    [[nodiscard]] std::string remark() const;

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
    [[nodiscard]] Pose pose(std::span<const Index> rows, const Points& first, Points& table) const;
    void bring_back(std::span<const Index> rows, const Pose& pose, const Points& before, const Points& first,
                    const Points& weights, Points& table) const;

    FlowOptions options_;
    bool is_attached_ = false;
    /// Whether steps have a K that depends on lengths of the first surface, not on present ones.
    bool has_kept_lengths_ = false;
    /// Empty where neither holds.
    Points first_;
    FindSmallComponents find_;
    /// Below it components are small; 0: no step needs this.
    double extent_ = 0.0;
    /// How many there were at most.
    Index most_ = 0;
};

}  // namespace seamflow
