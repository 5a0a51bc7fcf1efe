#pragma once

#include <optional>
#include <vector>

#include "engine/options/flow_report.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh in the form in which it flows: as it was given, or as a copy, near the origin where the given one lies far
/// from it (see origin_offset), and without faces that repeat others. Both move together.
class FlowingMesh {
  public:
    /// @param given must outlive this, which alone moves it.
    explicit FlowingMesh(PolygonMesh& given);

    /// The mesh that flows. Its address does not change.
    [[nodiscard]] const PolygonMesh& mesh() const { return copy_ ? *copy_ : *given_; }

    /// Leaves out faces that repeat others. A surface whose faces occur twice (to be seen from both sides, say) is
    /// manifold nowhere, but flows like the single one. To be called at most once, before anything refers to mesh().
    /// @param topology of mesh(): only places where it is not manifold are searched.
    /// @returns whether there were any.
    bool leave_out_repeated_faces(const Topology& topology);

    /// The labels of the faces that are left. Labels of a wrong number stay as they are.
    [[nodiscard]] std::vector<Index> of_faces_left(const std::vector<Index>& labels) const;

    /// Moves the vertices.
    /// @param positions #V by 3, of mesh().
    void move_to(const Points& positions);

    /// #V by 3: the positions of the given mesh.
    [[nodiscard]] const Points& given_positions() const { return given_->vertices; }

    /// Whether the given mesh lies elsewhere.
    [[nodiscard]] bool is_shifted() const { return !offset_.isZero(0.0); }

    /// Positions near the origin to where they belong. Vertices without faces, for which the difference may not be
    /// exact, are where they were at first, bit for bit: nothing moves them.
    /// @param positions #V by 3, and any number of further rows.
    void shift_back(Points& positions) const;

    /// Makes the report one of the given mesh: faces that were left out have the sub-mesh of the face that they repeat.
    void complete(FlowReport& report) const;

  private:
    PolygonMesh* given_;
    Point offset_;
    std::optional<PolygonMesh> copy_;
    /// Where the given mesh lies far away: the vertices without faces, and where they are.
    std::vector<Index> isolated_;
    Points of_isolated_ = Points(0, 3);
    /// Per face of the given mesh: the number that it, or the one that it repeats, has among those that are left. Empty
    /// where none is repeated.
    std::vector<Index> number_;
};

}  // namespace seamflow
