#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/executor.h"
#include "partition/metrics/length_statistics.h"
#include "partition/metrics/roughness.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The size of one body of a surface (see SurfaceComponents).
struct BodySize {
    /// Length².
    double area = 0.0;
    /// Length³; empty if it encloses none.
    std::optional<double> volume;
};

/// The visible properties of a surface: of the faces that flow, those that lie on each other once.
struct SurfaceLook {
    /// Of all faces, length².
    double area = 0.0;
    /// Length³; empty if the surface encloses none (see encloses_volume), or none above rounding.
    std::optional<double> volume;
    /// Where sheets meet: of each cell that they enclose, length³ (see EnclosedCells), the one that was largest before
    /// first.
    std::vector<double> cell_volumes = {};
    /// Of each body, if there are several.
    std::vector<BodySize> bodies = {};
    /// Of large meshes, from a sample of their faces.
    std::optional<Roughness> roughness;
    /// The number of pairs of faces that cross each other (see self_intersections), if requested.
    std::optional<std::size_t> self_intersections = std::nullopt;
};

/// The change of a surface.
struct SurfaceChange {
    SurfaceLook before;
    SurfaceLook after;
    /// Of the distances of vertices from their earlier positions, in units of length.
    LengthStatistics moved;
    /// The number of faces that have turned by more than 90° (see flipped_faces), and how many of these the surface has
    /// folded over (see folded_faces). Empty where they are not counted.
    std::optional<std::size_t> flipped_faces = std::nullopt;
    std::optional<std::size_t> folded_faces = std::nullopt;
    /// At how many edges sheets lay on each other with different faces before, so that the volumes of cells are unknown
    /// and left out (see EnclosedCells::n_overlaps).
    std::size_t overlaps = 0;
    /// The number of surfaces around cells (see EnclosedCells::n_surfaces).
    std::size_t surfaces = 0;
    /// The number of pairs of faces that cross each other but did not before, if requested.
    std::optional<std::size_t> new_self_intersections = std::nullopt;
};

/// Compares a surface with its earlier state. Reads the mesh a few times; the bits do not depend on how loops are run.
class SurfaceChangeMeter {
  public:
    /// Stores the positions of the vertices before they move.
    SurfaceChangeMeter(const PolygonMesh& mesh, const Executor& exec);

    /// @param mesh the same faces, with other positions of the vertices.
    /// @param report of the flow: the surface continues where vertices move as one, and has cells where sheets meet.
    /// @param finds_crossings whether to look for self-intersections, which takes longer than all the rest.
    [[nodiscard]] SurfaceChange measure(const PolygonMesh& mesh, const MeshReport& report, bool finds_crossings,
                                        const Executor& exec) const;

  private:
    Points positions_;
};

}  // namespace seamflow
