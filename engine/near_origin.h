#pragma once

#include "engine/flow_report.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// What to subtract from positions that lie far from the origin against their own extent, so that the flow does not
/// lose the precision that their distance takes: a point near their middle, on a grid so coarse that the difference is
/// exact. Zero for positions that do not lie far away, for none, and where any is not finite.
Point offset_of(const Points& positions);

/// A mesh brought near the origin as long as this lives; the positions that it has then are brought back.
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
    PolygonMesh* mesh_;
    Point offset_;
};

}  // namespace seamflow
