#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/rounding/bounded_fairing.h"
#include "solvers/rounding/kept_volumes.h"
#include "solvers/rounding/surface_parts.h"

namespace seamflow {

/// The neighbours over which normals are averaged.
enum class NormalNeighbours {
    /// All of them on the same sheet: the surface becomes smooth everywhere.
    All,
    /// Those with nearly the same normals: edges are kept.
    SameSideOfEdge,
};

/// Smooths the normals of a surface within boxes: averages normals, fits the vertices to them as far as the boxes
/// allow, and restores volumes, again and again.
class NormalsInBoxes {
  public:
    /// @param mesh its vertices are not used. @param parts of the same mesh. @param volumes those that are restored.
    /// All must outlive the object.
    NormalsInBoxes(const PolygonMesh& mesh, const Topology& topology, const SurfaceParts& parts,
                   const KeptVolumes& volumes, const Boxes& boxes, const Executor& exec);

    /// Smooths in groups of rounds, until a group makes the surface bend hardly less.
    /// @param positions #V by 3: in the boxes; replaced.
    /// @param to_beat there are no further groups if after the first one no part bends less than this. Empty: there may
    /// be.
    /// @returns the bending of each part of the result (see SurfaceParts::bending).
    std::vector<double> smooth(NormalNeighbours neighbours, Points& positions, const std::vector<double>& to_beat = {});

    /// The bending of each part at other positions, #V by 3.
    [[nodiscard]] std::vector<double> bending(const Points& positions) const
    {
        return parts_.bending(boxes_, positions, exec_);
    }

  private:
    void smooth_once(NormalNeighbours neighbours, Points& positions);
    void average_normals(NormalNeighbours neighbours);
    void fit(Points& positions) const;

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const SurfaceParts& parts_;
    const KeptVolumes& volumes_;
    const Boxes& boxes_;
    const Executor& exec_;
    FaceAverages averages_;
    /// #F: the averaged normals, and memory for averages.
    FaceVectors normals_;
    FaceVectors means_;
};

}  // namespace seamflow
