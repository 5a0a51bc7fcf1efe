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
    /// Notes what there is before it changes.
    SurfaceChangeMeter(const PolygonMesh& mesh, const Loop& loop);

    /// @param mesh the same faces, with the vertices somewhere else.
    [[nodiscard]] SurfaceChange measure(const PolygonMesh& mesh, const Loop& loop) const;

  private:
    [[nodiscard]] SurfaceLook look_at(const PolygonMesh& mesh, const Loop& loop) const;

    Points positions_;
    /// Some of the faces, and which vertices of the mesh theirs are.
    PolygonMesh sample_;
    std::vector<Index> sampled_vertices_;
    bool has_volume_;
    SurfaceLook before_;
};

}  // namespace seamflow
