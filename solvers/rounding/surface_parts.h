#pragma once

#include <cstddef>
#include <vector>

#include "partition/connected_components.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/rounding/bounded_fairing.h"

namespace seamflow {

/// The parts of a surface that are judged one by one: its components, but for small ones, which are one part together.
class SurfaceParts {
  public:
    /// @param mesh its vertices are not used. @param components those of its faces. All must outlive the object.
    SurfaceParts(const PolygonMesh& mesh, const Topology& topology, const Components& components);

    [[nodiscard]] Index count() const { return count_; }
    [[nodiscard]] const PolygonMesh& mesh() const { return mesh_; }

    [[nodiscard]] Index of_face(Index f) const { return part_of_[components_.component_of[f]]; }

    /// The part of the first face of a vertex; -1 for vertices without faces.
    [[nodiscard]] Index of_vertex(Index v) const;

    /// The total bending of each part: Σ l θ over its edges of two faces, with the length l and the angle θ between the
    /// normals of the faces. It is the same for a convex body and its rounded copies, however sharp its edges are, and
    /// grows with every wave: what stairs add to it disappears with them.
    /// @param boxes edges of a vertex that cannot move do not count. @param positions #V by 3.
    [[nodiscard]] std::vector<double> bending(const Boxes& boxes, const Points& positions,
                                              const Executor& exec = run_serially) const;

  private:
    /// Components with fewer faces are small.
    static constexpr std::size_t small_component = 200;

    /// l θ of the edge of half-edge h; 0 for the higher of two half-edges.
    [[nodiscard]] double bending_at(Index h, const Boxes& boxes, const Points& positions) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const Components& components_;
    /// Per component. Part 0 has the small ones.
    std::vector<Index> part_of_;
    Index count_ = 1;
};

}  // namespace seamflow
