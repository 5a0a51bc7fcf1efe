#pragma once

#include <span>
#include <vector>

#include "partition/index.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// Edges of a mesh that are kept as they are. A vertex between two of them slides along the line that they form, up to
/// the midpoints of both; vertices at ends of lines, and where more than two edges meet, do not move. Faces on both
/// sides of a line are not connected there (see cut_open).
class FeatureLines {
  public:
    /// No lines.
    FeatureLines() = default;

    /// @param mesh valid; the lines stay where its vertices are. @param topology of the mesh, with twins; neither is
    /// needed later. @param edges in any order, repetitions are allowed.
    /// @throws InputError naming the first pair that is no edge of a face.
    FeatureLines(const PolygonMesh& mesh, const Topology& topology, std::span<const Edge> edges);

    [[nodiscard]] bool empty() const { return edges_.empty(); }

    /// The faces of the mesh with one vertex for each side of the lines at a vertex, so that no edge or vertex joins
    /// the sides except at ends of lines. All positions are 0.
    [[nodiscard]] PolygonMesh cut_open(const PolygonMesh& mesh, const Topology& topology) const;

    /// The position of a vertex that would move to p: the nearest point of its line; p itself for a vertex on no line.
    [[nodiscard]] Point on_line(Index v, const Point& p) const;

  private:
    /// A vertex of a line, and the middles of its two edges; all three are equal if the vertex does not move.
    struct LineVertex {
        Point here;
        Point before;
        Point after;
    };

    /// Ascending, without repetitions, the lower vertex of each edge first.
    std::vector<Edge> edges_;
    /// #V: the index of the vertex in line_vertices_; -1 for vertices on no line.
    std::vector<Index> line_vertex_of_;
    std::vector<LineVertex> line_vertices_;
};

}  // namespace seamflow
