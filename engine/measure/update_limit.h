#pragma once

#include <optional>
#include <span>
#include <string>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A limit on how far a step may move a vertex. A result that is not finite, or that throws a vertex further than the
/// mesh is wide, is a failure.
class UpdateLimit {
  public:
    /// @param mesh in its state before the first step; must outlive the limit.
    /// @param diagonals how far a vertex may go in one step, in diagonals of the bounding box that the vertices of the
    ///        faces have now (see AccuracyOptions::largest_update).
    UpdateLimit(const PolygonMesh& mesh, double diagonals);

    /// Checks one step.
    /// @param before, after #V by 3.
    /// @param labels #F, the sub-mesh of every face, for the message.
    /// @throws ComputationError naming sub-mesh and vertex (both numbered from 0) and what to do.
    void require(const Points& before, const Points& after, std::span<const Index> labels) const;

  private:
    /// A vertex that goes too far, and what it would do, in words.
    struct Excess {
        Index vertex = 0;
        std::string what;
    };

    /// The vertex that goes furthest, if that is too far.
    [[nodiscard]] std::optional<Excess> find(const Points& before, const Points& after) const;

    const PolygonMesh& mesh_;
    double diagonal_ = 0.0;
    /// Units of length.
    double largest_ = 0.0;
};

}  // namespace seamflow
