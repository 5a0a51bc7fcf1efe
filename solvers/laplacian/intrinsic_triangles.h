#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Triangles that are given by their shapes, and by the edges that they share: a surface without an embedding in space.
/// Each triangle lies in a plane of its own, counterclockwise. Half-edge h runs from corner h % 3 of triangle h / 3 to
/// the next one.
class IntrinsicTriangles {
  public:
    /// @param mesh triangles. @param topology of the mesh.
    IntrinsicTriangles(const PolygonMesh& mesh, const Topology& topology);

    /// The half-edge after h, and the half-edge before h, in its triangle.
    static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Index previous(Index h) { return next(next(h)); }
    [[nodiscard]] Index n_triangles() const { return static_cast<Index>(corners_.size()); }
    [[nodiscard]] const std::array<Index, 3>& corners(Index t) const { return corners_[t]; }
    /// The area of a triangle, in length².
    [[nodiscard]] double area(Index t) const;
    /// The half-edge of the other triangle at the same edge; -1 if there is none, or several.
    [[nodiscard]] Index twin(Index h) const { return twin_[h]; }
    [[nodiscard]] Index start(Index h) const { return corners_[h / 3][usize(h % 3)]; }
    [[nodiscard]] Index end(Index h) const { return start(next(h)); }
    [[nodiscard]] double length(Index h) const { return edge(h).norm(); }
    /// Half the cotangent of the angle opposite to a half-edge; large, but finite, in a triangle without area; 0 if one
    /// of the other two edges has no length.
    [[nodiscard]] double half_cotangent(Index h) const;

    /// Flips edges until they are Delaunay, as far as possible.
    /// @param positions #V by 3: no flip is made that leaves a triangle without area at these positions.
    void flip_to_delaunay(const Points& positions);

  private:
    using Vector = Eigen::RowVector2d;

    [[nodiscard]] const Vector& edge(Index h) const { return edges_[h]; }
    [[nodiscard]] bool is_far_from_delaunay(Index h) const;
    [[nodiscard]] bool are_joined(Index h, Index v) const;
    bool flip(Index h, const Points& positions);
    void turn_over(Index t);
    void make_twins(Index h, Index twin);

    std::vector<std::array<Index, 3>> corners_;
    /// Per half-edge: its vector in the plane of its triangle.
    std::vector<Vector> edges_;
    std::vector<Index> twin_;
};

}  // namespace seamflow
