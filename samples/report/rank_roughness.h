#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/metrics/roughness.h"

namespace seamflow {

/// The roughness of a mesh that ranks share: rank 0 measures the sample of faces that `smooth` takes, which is small.
/// The bits are those of `smooth` for any number of ranks.
class RankRoughness {
  public:
    /// @param part of this rank, must outlive this. @param n_vertices of the whole mesh.
    RankRoughness(const MeshPart& part, std::int64_t n_vertices);

    /// That of the part's vertices as they are now. All ranks call this together.
    /// @returns at rank 0; the others know nothing of it.
    [[nodiscard]] Roughness measure(Communicator& comm) const;

  private:
    const MeshPart* part_;
    /// Faces of the part, ascending.
    std::vector<Index> sample_;
};

}  // namespace seamflow
