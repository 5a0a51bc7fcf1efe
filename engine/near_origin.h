#pragma once

#include <vector>

#include "engine/flow_report.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// What to subtract from the positions of a surface that lies far from the origin against its own extent, so that the
/// flow does not lose the precision that its distance takes: a point near its middle, on a grid so coarse that the
/// difference is exact. Vertices without faces play no part in it. Zero for a surface that does not lie far away, for
/// none, where any position is not finite, and where a face names a vertex that is not there.
Point offset_of(const PolygonMesh& mesh);

/// A mesh brought near the origin as long as this lives; the positions that it has then are brought back. Vertices
/// without faces, for which the difference may not be exact, are those of before then, bit for bit: nothing moves them.
class NearOrigin {
  public:
    NearOrigin(PolygonMesh& mesh, const Point& offset);
    NearOrigin(const NearOrigin&) = delete;
    NearOrigin& operator=(const NearOrigin&) = delete;
    ~NearOrigin();

    /// An observer that tells `inner` where everything is in truth.
    [[nodiscard]] StepObserver observing(const StepObserver& inner) const;

    /// Where the mesh is in truth.
    [[nodiscard]] PolygonMesh brought_back(PolygonMesh mesh) const;

  private:
    void bring_back(Points& positions) const;

    PolygonMesh* mesh_;
    Point offset_;
    /// The vertices without faces, and where they are in truth.
    std::vector<Index> isolated_;
    Points of_isolated_;
};

}  // namespace seamflow
