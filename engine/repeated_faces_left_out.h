#pragma once

#include <vector>

#include "engine/flow_options.h"
#include "engine/flow_report.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes faces that repeat others out of a mesh as long as this lives: a surface whose faces are there twice (for being
/// seen from both sides, say) is manifold nowhere, but flows like the single one. Looks for them where the mesh is not
/// manifold alone.
class RepeatedFacesLeftOut {
  public:
    /// @param options its labels become those of the faces that are left. With FlowOptions::keep_gaps nothing is left
    ///        out: the pieces have all faces.
    RepeatedFacesLeftOut(PolygonMesh& mesh, const Topology& topology, FlowOptions& options);
    RepeatedFacesLeftOut(const RepeatedFacesLeftOut&) = delete;
    RepeatedFacesLeftOut& operator=(const RepeatedFacesLeftOut&) = delete;
    ~RepeatedFacesLeftOut();

    /// How many were taken out.
    [[nodiscard]] Index count() const { return count_; }

    /// Makes the report one of all faces: those left out have the sub-mesh of the face that they repeat.
    void complete(FlowReport& report) const;

  private:
    PolygonMesh* mesh_;
    Index count_ = 0;
    /// Of all faces; empty where none is repeated.
    std::vector<Index> face_offsets_;
    std::vector<Index> face_vertices_;
    /// Per face: the number that it, or the one that it repeats, has among those that are left.
    std::vector<Index> number_;
};

}  // namespace seamflow
