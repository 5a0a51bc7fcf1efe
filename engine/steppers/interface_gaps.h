#pragma once

#include <optional>
#include <vector>

#include "engine/steppers/sub_mesh_state.h"
#include "partition/decomposition/separated_sub_meshes.h"
#include "partition/metrics/length_statistics.h"

namespace seamflow {

/// The sub-meshes' copies of Γ where each has its own: how far apart they are, the mean that represents them, and the
/// sub-meshes, each with its own. Runs in parallel, sums in order: the bits do not depend on the number of threads.
class InterfaceGaps {
  public:
    /// @param decomposition must outlive this.
    /// @param keeps_separated whether separated() is wanted.
    InterfaceGaps(const PolygonMesh& mesh, const Decomposition& decomposition, bool keeps_separated);

    /// Takes over the positions of all sub-meshes after a step.
    /// @param positions #V by 3; receives the mean of the copies of each vertex of Γ.
    void join(const std::vector<SubMeshState>& states, Points& positions);

    /// Over the vertices of Γ after the last join, the largest distance between two copies, in units of length.
    [[nodiscard]] LengthStatistics gap() const { return length_statistics(gaps_); }

    /// The sub-meshes as of the last join, or null.
    [[nodiscard]] const PolygonMesh* separated() const { return separated_ ? &separated_->mesh : nullptr; }

  private:
    void join_interface_of(Index s, const std::vector<SubMeshState>& states, Points& positions);

    const Decomposition* decomposition_;
    std::optional<SeparatedSubMeshes> separated_;
    /// For each sub-mesh, the index of its first entry in `gaps_`: it has one per vertex of Γ where it is the lowest.
    std::vector<std::size_t> first_gap_;
    std::vector<double> gaps_;
};

}  // namespace seamflow
