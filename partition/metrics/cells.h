#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The cells that the faces of a mesh enclose: the bounded regions of space between sheets that meet, such as the
/// bubbles of a foam, however faces are oriented. Regions that are connected through a hole in a sheet are one region,
/// and no cell if one of them is the outside. A body within a cell whose sheets meet the sheets of the cell at no edge
/// is a cell of its own, and its volume also counts in that of the cell around it.
struct EnclosedCells {
    /// One list for each cell, the largest cell first: the sides of faces around it, 2 f for the side of face f to
    /// which its normal points, and 2 f + 1 for the other. Faces with both sides in one cell are left out.
    IndexLists sides;
    /// The number of overlaps: edges at which two faces lie on each other while the region between them, which should
    /// be empty, has a volume. The two sheets then have different faces there. The cells on both sides may count as
    /// one: unless this is 0, volumes are not valid, and callers should not use the cells.
    Index n_overlaps = 0;
    /// The number of surfaces around cells that meet each other at no edge: some may lie within others.
    Index n_surfaces = 0;

    [[nodiscard]] Index count() const { return sides.size(); }
};

/// Finds the cells. The same bits for every executor. Linear in the size of the mesh, except for sorting at edges of
/// three faces or more. Sheets may lie on each other if they have the same faces there, or the same quads, cut along
/// one diagonal or the other.
/// @param positions #V by 3, not necessarily those of the mesh; where sheets cross each other, cells are not valid.
EnclosedCells find_cells(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// The volume of each cell in length³, negative for cells that are turned inside out.
/// @param positions #V by 3, not necessarily those with which the cells were found.
std::vector<double> volumes_of(const EnclosedCells& cells, const PolygonMesh& mesh, const Points& positions,
                               const Executor& exec = run_serially);

}  // namespace seamflow
