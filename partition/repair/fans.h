#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Walks around vertices, one after the other, without allocating memory for each.
class FanWalker {
  public:
    /// All faces of a mesh that follow each other around a vertex, each sharing an edge at the vertex with the next. At
    /// an interior vertex it is closed and the only one, at an ordinary boundary vertex open and the only one.
    struct Fan {
        /// In order around the vertex; valid until the next call of the walker.
        std::span<const Index> faces;
        bool closed = false;
    };

    /// The mesh and its topology must outlive the walker.
    FanWalker(const PolygonMesh& mesh, const Topology& topology);

    /// The fans at vertex v, in order of their lowest face; valid until the next call.
    std::span<const Fan> at_vertex(Index v);

  private:
    struct Step {
        Index corner;
        Index spoke;
    };

    [[nodiscard]] Step start(Index corner) const;
    [[nodiscard]] Step across(Index v, Index spoke) const;
    bool append_fan(Index v, Index corner);

    const PolygonMesh* mesh_;
    const Topology* topology_;
    /// Of the vertex in hand, per corner: whether its face has been met.
    std::vector<bool> met_;
    std::vector<Index> faces_;
    std::vector<Fan> fans_;
};

}  // namespace seamflow
