#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "partition/executor.h"
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
    /// How many pairs of faces cross each other (see self_intersections), if it was asked for.
    std::optional<std::size_t> self_intersections = std::nullopt;
};

/// What has become of it.
struct SurfaceChange {
    SurfaceLook before;
    SurfaceLook after;
    /// Of the distances from where vertices were, in units of length.
    LengthStatistics moved;
    /// How many faces have turned by more than 90° (see flipped_faces), and how many of them the surface has folded
    /// over (see folded_faces).
    std::size_t flipped_faces = 0;
    std::size_t folded_faces = 0;
    /// How many pairs of faces cross each other that did not before, if it was asked for.
    std::optional<std::size_t> new_self_intersections = std::nullopt;
};

/// Compares a surface with what it was. Reads the mesh a few times; the bits do not depend on how loops are run.
class SurfaceChangeMeter {
  public:
    /// Notes where the vertices are before they move.
    SurfaceChangeMeter(const PolygonMesh& mesh, const Executor& exec);

    /// @param mesh the same faces, with the vertices somewhere else.
    /// @param moved_with see MeshReport::moved_with: the surface goes on where vertices move as one.
    /// @param finds_crossings whether to look for self-intersections, which takes longer than all the rest.
    [[nodiscard]] SurfaceChange measure(const PolygonMesh& mesh, const std::vector<Index>& moved_with,
                                        bool finds_crossings, const Executor& exec) const;

  private:
    Points positions_;
};

}  // namespace seamflow
