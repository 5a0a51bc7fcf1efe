#pragma once

#include <optional>
#include <vector>

#include "partition/loop.h"
#include "partition/metrics/length_statistics.h"
#include "partition/metrics/roughness.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What a user sees of a surface.
struct SurfaceLook {
    /// Of all faces, length².
    double area = 0.0;
    /// Length³; empty where it has none (see encloses_volume).
    std::optional<double> volume;
    /// Of large meshes by a sample of their faces.
    Roughness roughness;
};

/// What has become of it.
struct SurfaceChange {
    SurfaceLook before;
    SurfaceLook after;
    /// Of the distances from where vertices were, in units of length.
    LengthStatistics moved;
};

/// Compares a surface with what it was. Reads the mesh a few times; the bits do not depend on how loops are run.
class SurfaceChangeMeter {
  public:
    /// Notes where the vertices are before they move.
    SurfaceChangeMeter(const PolygonMesh& mesh, const Loop& loop);

    /// @param mesh the same faces, with the vertices somewhere else.
    /// @param moved_with see MeshReport::moved_with: the surface goes on where vertices move as one.
    [[nodiscard]] SurfaceChange measure(const PolygonMesh& mesh, const std::vector<Index>& moved_with,
                                        const Loop& loop) const;

  private:
    Points positions_;
};

}  // namespace seamflow
