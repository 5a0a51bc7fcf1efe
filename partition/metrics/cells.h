#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The cells that the faces of a mesh enclose: the bounded regions of space between sheets that meet, such as the
/// bubbles of a foam, however faces are oriented. A region with a hole in its sheets is one with what is
/// behind the hole, and no cell if that is the outside. What lies within a cell, touching its sheets at no edge, is a
/// cell of its own, and counts in the volume of the one around it, too.
struct EnclosedCells {
    /// One list for each cell, the largest cell first: the sides of faces around it, 2 f for the side of face f that
    /// its normal points to, and 2 f + 1 for the other. Faces with both sides in one cell are left out.
    IndexLists sides;
    /// At how many edges two faces lie on each other, and what should be nothing between them has a volume: parts of
    /// sheets that have different faces there. The cells on both sides may then be one, and volumes mean nothing.
    Index n_overlaps = 0;
    /// The number of surfaces around cells that touch each other at no edge: some may lie in others.
    Index n_surfaces = 0;

    [[nodiscard]] Index count() const { return sides.size(); }
};

/// Finds the cells. The same bits for every executor. Linear in the size of the mesh, but for sorting at edges of three
/// faces or more. Sheets may lie on each other if they have the same faces there, or
/// the same quads, cut along one diagonal or the other.
/// @param positions #V by 3, not necessarily those of the mesh; where sheets cross each other, cells mean nothing.
EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The volume of each cell in length³, negative for cells turned inside out.
/// @param positions #V by 3, not necessarily those that the cells were found with.
std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec = run_serially);

}  // namespace seamflow
