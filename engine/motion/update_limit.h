#pragma once

#include <optional>
#include <span>
#include <string>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A limit on the displacement of a vertex in a step. A result that is not finite, or that throws a vertex further than
/// the mesh is wide, is a failure.
class UpdateLimit {
  public:
    /// @param mesh in its state before the first step; must outlive the limit.
    /// @param diagonals the largest displacement of a vertex in one step, in diagonals of the present bounding box of
    ///        the faces (see AccuracyOptions::largest_update).
    UpdateLimit(const PolygonMesh& mesh, double diagonals);

    /// Checks one step.
    /// @param before, after #V by 3.
    /// @param labels #F, the sub-mesh of every face, for the message; empty: there are no sub-meshes.
    /// @throws ComputationError naming sub-mesh and vertex (both numbered from 0) and a remedy.
    void require(const Points& before, const Points& after, std::span<const Index> labels) const;

  private:
    /// A vertex whose displacement is too large, and a description of it in words.
    struct Excess {
        Index vertex = 0;
        std::string what;
    };

    /// The first vertex whose position is not finite, or else the vertex with the largest displacement, if that is too
    /// large; empty: the step is within the limit.
    [[nodiscard]] std::optional<Excess> find(const Points& before, const Points& after) const;

    const PolygonMesh& mesh_;
    /// The diagonal of the bounding box of the faces when the limit was made.
    double diagonal_ = 0.0;
    /// The largest displacement, in units of length.
    double largest_ = 0.0;
};

}  // namespace seamflow
