#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/metrics/roughness.h"

namespace seamflow {

/// The roughness of a mesh that ranks share: rank 0 measures the small sample of faces that `smooth` takes. The result
/// has the same bits as that of `smooth` for any number of ranks.
class RankRoughness {
  public:
    /// @param part of this rank, must outlive this. @param n_vertices of the whole mesh.
    RankRoughness(const MeshPart& part, std::int64_t n_vertices);

    /// The roughness with the present positions of the part's vertices. All ranks call this together.
    /// @returns the roughness at rank 0 only; nothing if no rank has faces of the sample.
    [[nodiscard]] std::optional<Roughness> measure(Communicator& comm) const;

  private:
    const MeshPart* part_;
    /// Faces of the part, ascending.
    std::vector<Index> sample_;
};

}  // namespace seamflow
