#pragma once

#include <span>
#include <vector>

#include "partition/index.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Edges of a mesh that are kept as they are. A vertex between two of them slides along the line that they form, up to
/// the midpoints of both; ends of lines and vertices where more of them meet stay. Faces on both sides of a line are
/// not connected there (see cut_open).
class FeatureLines {
  public:
    /// Without edges there is nothing to keep.
    FeatureLines() = default;

    /// @param mesh valid, with the lines where they are to stay. @param topology of the mesh, with twins; neither is
    /// needed later. @param edges in any order, repetitions are allowed.
    /// @throws InputError naming the first pair that is no edge of a face.
    FeatureLines(const PolygonMesh& mesh, const Topology& topology, std::span<const Edge> edges);

    [[nodiscard]] bool empty() const { return edges_.empty(); }

    /// The faces of the mesh with one vertex for each side of the lines at a vertex, so that no edge or vertex joins
    /// the sides except at ends of lines. All positions are 0.
    [[nodiscard]] PolygonMesh cut_open(const PolygonMesh& mesh, const Topology& topology) const;

    /// Where a vertex that would move to p ends: on its line, or at p for a vertex on none.
    [[nodiscard]] Point on_line(Index v, const Point& p) const;

  private:
    /// Halves of the two edges at a vertex; of zero length if it stays.
    struct Place {
        Point here;
        Point before;
        Point after;
    };

    /// Ascending, each once, the lower vertex first.
    std::vector<Edge> edges_;
    /// #V: the number of its place, -1 off all lines.
    std::vector<Index> place_of_;
    std::vector<Place> places_;
};

}  // namespace seamflow
