#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>

#include "partition/polygon_mesh.h"

/// Helpers that several generators share.
namespace seamflow {

/// A grid of vertices, numbered row by row.
struct Grid {
    Index columns = 0;
    Index rows = 0;

    [[nodiscard]] Index vertex(Index column, Index row) const { return row * columns + column; }
    [[nodiscard]] Index size() const { return columns * rows; }
    [[nodiscard]] bool on_border(Index column, Index row) const
    {
        return column == 0 || row == 0 || column == columns - 1 || row == rows - 1;
    }
};

/// About `vertices` grid vertices, `aspect` times as many columns as rows.
Grid grid_of(Index vertices, double aspect);

/// @throws OptionError unless there are 100 to 100,000,000.
void require_vertices(Index vertices);

/// @throws OptionError unless `value` is between the limits (and a number).
void require_between(const char* name, double value, double least, double most);

/// An empty mesh with room for that many vertices, corners and faces.
PolygonMesh mesh_with_room(Index vertices, std::size_t corners, std::size_t faces);

inline void add_face(PolygonMesh& mesh, std::initializer_list<Index> corners)
{
    mesh.add_face(std::span<const Index>(corners.begin(), corners.size()));
}

}  // namespace seamflow
