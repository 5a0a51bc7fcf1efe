#pragma once

#include <optional>
#include <vector>

#include "engine/sweep/sub_mesh_state.h"
#include "partition/decomposition/separated_sub_meshes.h"
#include "partition/metrics/length_statistics.h"

namespace seamflow {

/// The gaps between the sub-meshes' copies of Γ, where each sub-mesh has its own copy: the distances, the mean that
/// represents the copies, and the sub-meshes as a mesh with all copies. Runs in parallel, sums in order: the bits do
/// not depend on the number of threads.
class InterfaceGaps {
  public:
    /// @param decomposition must outlive this.
    /// @param keeps_separated whether separated() will be called.
    InterfaceGaps(const PolygonMesh& mesh, const Decomposition& decomposition, bool keeps_separated);

    /// Reads the positions of all sub-meshes after a step.
    /// @param positions #V by 3; receives the mean of the copies of each vertex of Γ.
    void join(const std::vector<SubMeshState>& states, Points& positions);

    /// Statistics over the vertices of Γ at the last join: of the largest distance between two copies of a vertex, in
    /// units of length.
    [[nodiscard]] LengthStatistics gap() const { return length_statistics(gaps_); }

    /// The sub-meshes at the last join, as a mesh with all copies of Γ; null unless keeps_separated.
    [[nodiscard]] const PolygonMesh* separated() const { return separated_ ? &separated_->mesh : nullptr; }

  private:
    void join_interface_of(Index s, const std::vector<SubMeshState>& states, Points& positions);

    const Decomposition* decomposition_;
    std::optional<SeparatedSubMeshes> separated_;
    /// For each sub-mesh, the index of its first entry in `gaps_`: it has one entry per vertex of Γ at which no other
    /// sub-mesh has a lower number.
    std::vector<std::size_t> first_gap_;
    /// Per vertex of Γ, in the order of first_gap_: the largest distance between two of its copies at the last join.
    std::vector<double> gaps_;
};

}  // namespace seamflow
